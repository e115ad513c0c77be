#pragma once

// The kinds of values that keys have: how each is read, checked and written.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "base/name_table.hpp"
#include "base/quantity.hpp"
#include "case/case_keys.hpp"

namespace fsi {

/// Where a value lies in a Target: a member, or a member of a member.
template <class Target, class Value>
struct Place {
  std::function<Value&(Target&)> find;

  Value& operator()(Target& target) const { return find(target); }
  const Value& operator()(const Target& target) const { return find(const_cast<Target&>(target)); }  // changes nothing
};
template <class Target, class Value>
Place<Target, Value> at(Value Target::*member) {
  return {[=](Target& target) -> Value& { return target.*member; }};
}
template <class Target, class Part, class Value>
Place<Target, Value> at(Part Target::*part, Value Part::*member) {
  return {[=](Target& target) -> Value& { return target.*part.*member; }};
}

/// Shortest text of a number with round-trip precision, with 1e-8 in place of 1e-08.
inline std::string text_for_people(double value) {
  return replaced(fmt::format("{}", value), "e-0", "e-");
}

/// A number in its bounds, with a warning if it seems to be in a wrong unit.
template <class Target, class Number>  // double, or an optional one
KeyValue<Target> number(Place<Target, Number> place, const Bounds& bounds,
                        const Quantity& measured = quantity::number()) {
  KeyValue<Target> value;
  value.read = [place, bounds, &measured](const CaseEntry& entry, Target& target) {
    const double given = entry.number();
    if (!bounds.contains(given)) entry.refuse_value(bounds.problem(), bounds.remedy());
    entry.warn_of_unit(measured, given);
    place(target) = given;
  };
  if constexpr (std::is_same_v<Number, double>) {
    value.write = [place](const Target& target) { return fmt::format("{}", place(target)); };
    value.standard = text_for_people(place(Target()));
  } else {
    value.write = [place](const Target& target) {
      return place(target) ? fmt::format("{}", *place(target)) : std::string("chosen");
    };
  }
  value.unit = measured.unit;
  return value;
}

/// A whole number from low to high. Choose the upper limit far above useful values, and far below where sums and
/// products of such numbers overflow.
template <class Target, class Whole>  // an integer, or an optional one
KeyValue<Target> whole(Place<Target, Whole> place, int low, int high) {
  KeyValue<Target> value;
  value.read = [=](const CaseEntry& entry, Target& target) { place(target) = entry.whole_number(low, high); };
  if constexpr (std::is_integral_v<Whole>) {
    value.write = [place](const Target& target) { return std::to_string(place(target)); };
    value.standard = value.write(Target());
  } else {
    value.write = [place](const Target& target) {
      return place(target) ? std::to_string(*place(target)) : std::string("chosen");
    };
  }
  return value;
}

template <class Target>
KeyValue<Target> flag(Place<Target, bool> place) {
  KeyValue<Target> value;
  value.read = [place](const CaseEntry& entry, Target& target) { place(target) = entry.boolean(); };
  value.write = [place](const Target& target) { return std::string(place(target) ? "true" : "false"); };
  value.standard = value.write(Target());
  return value;
}

template <class Target>
KeyValue<Target> any_text(Place<Target, std::string> place) {
  return {[place](const CaseEntry& entry, Target& target) { place(target) = entry.line(); },
          [place](const Target& target) { return place(target); }};
}

/// \param planned  names of choices not available yet: refused, but not as misspelt \throws InputError
inline void require_name(const CaseEntry& entry, const std::vector<std::string>& names,
                         const std::vector<std::string>& planned = {}) {
  const auto name = entry.text();
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  if (std::find(planned.begin(), planned.end(), name) != planned.end())
    entry.refuse_name("is not available yet", "give " + one_of(names));
  entry.refuse_name("is unknown", name_remedy(name, names));
}

/// "a, b (default) or c"
inline std::string marked(std::vector<std::string> names, const std::string& standard) {
  for (auto& name : names)
    if (name == standard) name += " (default)";
  return one_of(names);
}

/// One of `names`, kept as text.
template <class Target>
KeyValue<Target> name_from(Place<Target, std::string> place, const std::vector<std::string>& names,
                           const std::vector<std::string>& planned = {}) {
  return {[=](const CaseEntry& entry, Target& target) {
            require_name(entry, names, planned);
            place(target) = entry.text();
          },
          [place](const Target& target) { return place(target); }, marked(names, place(Target()))};
}

/// The same for a choice that the program makes unless the case does.
template <class Target>
KeyValue<Target> name_from(Place<Target, std::optional<std::string>> place, const std::vector<std::string>& names) {
  KeyValue<Target> value;
  value.read = [=](const CaseEntry& entry, Target& target) {
    require_name(entry, names);
    place(target) = entry.text();
  };
  value.write = [place](const Target& target) { return place(target).value_or("chosen"); };
  value.standard = one_of(names);
  return value;
}

/// A name of the table, kept as what it stands for.
template <class Target, class Choice>
KeyValue<Target> name_from(Place<Target, Choice> place, const NameTable<Choice>& table) {
  return {[place, &table](const CaseEntry& entry, Target& target) {
            require_name(entry, table.names());
            place(target) = table.at(entry.text());
          },
          [place, &table](const Target& target) { return table.name_of(place(target)); },
          marked(table.names(), table.name_of(place(Target())))};
}

/// The same for an optional choice.
template <class Target, class Choice>
KeyValue<Target> name_from(Place<Target, std::optional<Choice>> place, const NameTable<Choice>& table) {
  return {[place, &table](const CaseEntry& entry, Target& target) {
            require_name(entry, table.names());
            place(target) = table.at(entry.text());
          },
          [place, &table](const Target& target) {
            return place(target) ? std::string(table.name_of(*place(target))) : std::string("chosen");
          },
          one_of(table.names())};
}

/// Coordinates, or a direction that must not be zero.
template <class Target>
KeyValue<Target> point(Place<Target, Point> place, bool nonzero) {
  KeyValue<Target> value;
  value.read = [=](const CaseEntry& entry, Target& target) {
    const auto coordinates = entry.elements();
    if (coordinates.size() != 3) entry.refuse_value("is no point", "give [x, y, z]");
    auto& p = place(target);
    for (std::size_t i = 0; i < 3; ++i) p[i] = coordinates[i].number();
    if (nonzero && std::hypot(p[0], p[1], p[2]) == 0)
      entry.refuse_value("has no direction", "give a vector other than 0");
  };
  value.write = [place](const Target& target) {
    const auto& p = place(target);
    return fmt::format("[{}, {}, {}]", p[0], p[1], p[2]);
  };
  value.standard = value.write(Target());
  value.unit = quantity::length().unit;
  return value;
}

}  // namespace fsi
