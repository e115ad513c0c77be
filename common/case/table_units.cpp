#include "case/table_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "base/names.hpp"

namespace fsi {

namespace {

struct Unit {
  ColumnKind kind;
  const char* name;  ///< normal spelling: no blanks, `_` or `^`, `/` for per
  double factor;
};

// A mmHg is 133.322 Pa, a cmH2O 98.0665 Pa (the conventional values of both).
constexpr std::array units = {
    Unit{ColumnKind::time, "ms", 1},
    Unit{ColumnKind::time, "s", 1e3},
    Unit{ColumnKind::time, "us", 1e-3},
    Unit{ColumnKind::time, "min", 6e4},
    Unit{ColumnKind::time, "msec", 1},
    Unit{ColumnKind::time, "sec", 1e3},
    Unit{ColumnKind::time, "second", 1e3},
    Unit{ColumnKind::time, "seconds", 1e3},
    Unit{ColumnKind::time, "millisecond", 1},
    Unit{ColumnKind::time, "milliseconds", 1},
    Unit{ColumnKind::time, "minute", 6e4},
    Unit{ColumnKind::time, "minutes", 6e4},
    Unit{ColumnKind::pressure, "kPa", 1},
    Unit{ColumnKind::pressure, "Pa", 1e-3},
    Unit{ColumnKind::pressure, "mmHg", 0.133322},
    Unit{ColumnKind::pressure, "cmH2O", 0.0980665},
    Unit{ColumnKind::pressure, "MPa", 1e3},
    Unit{ColumnKind::pressure, "hPa", 0.1},
    Unit{ColumnKind::pressure, "mbar", 0.1},
    Unit{ColumnKind::pressure, "bar", 100},
    Unit{ColumnKind::pressure, "torr", 0.133322},
    Unit{ColumnKind::pressure, "dyn/cm2", 1e-4},
    Unit{ColumnKind::pressure, "N/m2", 1e-3},
    Unit{ColumnKind::flow_rate, "mm3/ms", 1},
    Unit{ColumnKind::flow_rate, "ml/s", 1},
    Unit{ColumnKind::flow_rate, "L/min", 1e3 / 60},
    Unit{ColumnKind::flow_rate, "ml/min", 1.0 / 60},
    Unit{ColumnKind::flow_rate, "cm3/s", 1},
    Unit{ColumnKind::flow_rate, "mm3/s", 1e-3},
    Unit{ColumnKind::flow_rate, "m3/s", 1e6},
    Unit{ColumnKind::flow_rate, "L/s", 1e3},
    Unit{ColumnKind::flow_rate, "cc/s", 1},
    Unit{ColumnKind::flow_rate, "ul/s", 1e-3},
    Unit{ColumnKind::flow_rate_of_depth, "mm2/ms", 1},
    Unit{ColumnKind::flow_rate_of_depth, "m2/s", 1e3},
    Unit{ColumnKind::flow_rate_of_depth, "cm2/s", 0.1},
    Unit{ColumnKind::flow_rate_of_depth, "mm2/s", 1e-3},
    Unit{ColumnKind::elastance, "kPa/mm3", 1},
    Unit{ColumnKind::elastance, "kPa/ml", 1e-3},
    Unit{ColumnKind::elastance, "mmHg/ml", 0.133322e-3},
    Unit{ColumnKind::elastance, "Pa/m3", 1e-12},
};
constexpr std::array velocities = {"m/s", "cm/s", "mm/s", "mm/ms"};

/// "ml per s", "mm^3_per_ms", "ml*s^-1": as the tables spell it.
std::string normal_spelling(std::string text) {
  const auto replace = [&](const std::string& from, const std::string& to) {
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  };
  replace("_", " ");
  replace(" per ", "/");
  for (const char* nothing : {" ", "^", "*"}) replace(nothing, "");
  replace("\u00b3", "3");
  replace("\u00b2", "2");
  replace("\u00b5", "u");
  replace("\u03bc", "u");
  for (const char* base : {"min", "ms", "s"})
    if (const std::string power = std::string(base) + "-1";
        text.size() > power.size() && text.compare(text.size() - power.size(), power.size(), power) == 0) {
      text = text.substr(0, text.size() - power.size()) + "/" + base;
      break;
    }
  return text;
}

/// The unit of this spelling. Upper and lower case do not matter but for mPa, which is not MPa.
const Unit* unit_of(const std::string& text) {
  const auto exact = std::find_if(units.begin(), units.end(), [&](const Unit& unit) { return unit.name == text; });
  if (exact != units.end()) return &*exact;
  if (text == "mPa") return nullptr;  // not MPa
  const auto alike = std::find_if(units.begin(), units.end(),
                                  [&](const Unit& unit) { return lower_case(unit.name) == lower_case(text); });
  return alike == units.end() ? nullptr : &*alike;
}

bool is_velocity(const std::string& text) {
  return std::find(velocities.begin(), velocities.end(), text) != velocities.end();
}

/// Whether text behind a name can only be a unit.
bool looks_like_unit(const std::string& text) {
  return text.find('/') != std::string::npos || text == "mPa";
}

const char* word_of(ColumnKind kind) {
  return kind == ColumnKind::time        ? "time"
         : kind == ColumnKind::pressure  ? "pressure"
         : kind == ColumnKind::elastance ? "elastance"
                                         : "flow rate";
}

/// The flow of a plane scene is that through 1 mm of thickness: mm^3/ms is mm^2/ms there.
bool fits(ColumnKind unit, ColumnKind wanted) {
  return unit == wanted || (unit == ColumnKind::flow_rate && wanted == ColumnKind::flow_rate_of_depth);
}

std::optional<ColumnUnit> accepted(const std::string& spelt, ColumnKind kind) {
  const std::string text = normal_spelling(spelt);
  if (const Unit* unit = unit_of(text)) {
    if (fits(unit->kind, kind)) return ColumnUnit{spelt, unit->factor};
    throw std::invalid_argument(
        fmt::format("{} is a unit of {}, not of {}", spelt,
                    unit->kind == ColumnKind::flow_rate_of_depth ? "the flow in a plane scene" : word_of(unit->kind),
                    word_of(kind)));
  }
  if (is_velocity(text))
    throw std::invalid_argument(fmt::format("{} is a unit of velocity, not of {}", spelt, word_of(kind)));
  return std::nullopt;
}

}  // namespace

std::string known_units(ColumnKind kind) {
  std::vector<std::string> names;
  for (const Unit& unit : units)
    if (fits(unit.kind, kind)) names.emplace_back(unit.name);
  return one_of(names);
}

std::optional<ColumnUnit> column_unit(std::string_view header, ColumnKind kind) {
  std::string text(header);
  text.erase(std::remove(text.begin(), text.end(), '"'), text.end());
  const auto open = text.find_first_of("([");
  if (open != std::string::npos) {
    const auto close = text.find_first_of(")]", open);
    const std::string inside = text.substr(open + 1, close == std::string::npos ? close : close - open - 1);
    if (auto unit = accepted(inside, kind)) return unit;
    throw std::invalid_argument(fmt::format("{} is no known unit of {}", inside, word_of(kind)));
  }
  // From the left, so that "ml_per_s" is found before "s".
  for (std::size_t from = 0; from != std::string::npos && from < text.size();) {
    if (auto unit = accepted(text.substr(from), kind)) return unit;
    const auto next = text.find_first_of("_ ", from);
    from = next == std::string::npos ? next : next + 1;
  }
  const auto blank = text.find_first_of("_ ");
  const std::string behind = blank == std::string::npos ? text : text.substr(blank + 1);
  if (looks_like_unit(normal_spelling(behind)))
    throw std::invalid_argument(fmt::format("{} is no known unit of {}", behind, word_of(kind)));
  return std::nullopt;
}

}  // namespace fsi
