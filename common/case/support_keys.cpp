#include "case/support_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "base/names.hpp"
#include "case/key_values.hpp"
#include "case/table_input.hpp"

namespace fsi {

namespace {

using presence::optional;
constexpr const char* normal_name = "normal";

/// A support as it stands in the file.
struct SupportInput {
  SupportData support;
  std::optional<TableInput> pressure;
  std::vector<TableInput> traction;  ///< per direction
  TableInput times;                  ///< until and period, of them all
};

/// The names of a scene's directions, in the order of its components.
std::vector<std::string> directions(Geometry geometry) {
  if (geometry == Geometry::axisymmetric) return {"r", "z"};
  if (geometry == Geometry::plane) return {"x", "y"};
  return {"x", "y", "z"};
}

/// Reads the rows of a table, each a time and a value per component.
void read_traction_rows(const CaseEntry& entry, std::vector<TableInput>& traction) {
  bool warned_of_time = false, warned_of_value = false;  // once is enough
  for (const CaseEntry& row : rows_of_table(entry)) {
    const auto numbers = row.is_array() ? row.elements() : std::vector<CaseEntry>{};
    if (numbers.size() < 2 || (!traction.empty() && numbers.size() != traction.size() + 1))
      row.refuse_value("is no row of this table", "give [time, a component per direction]");
    traction.resize(numbers.size() - 1);
    const double time = numbers[0].number();
    if (!warned_of_time) warned_of_time = numbers[0].warn_of_unit(quantity::time(), time);
    for (std::size_t k = 0; k < traction.size(); ++k) {
      const double value = numbers[k + 1].number();
      if (!warned_of_value) warned_of_value = numbers[k + 1].warn_of_unit(quantity::pressure(), value);
      traction[k].is_table = true;
      traction[k].table.points.emplace_back(time, value);
    }
    check_last_row(traction.front().table.points,
                   [&](const std::string& problem, const std::string& remedy) { row.refuse_value(problem, remedy); });
  }
}

void read_traction(const CaseEntry& entry, SupportInput& input) {
  const auto elements = entry.elements();
  if (elements.empty()) entry.refuse_name("is empty", "give a component per direction of the scene");
  auto& traction = input.traction;
  if (elements.front().is_array()) return read_traction_rows(entry, traction);
  for (const CaseEntry& component : elements)
    traction.emplace_back().table.points = {{0.0, component.number(quantity::pressure())}};
}

void read_fixed(const CaseEntry& entry, SupportInput& input) {
  auto& fixed = input.support.fixed.emplace();
  for (const CaseEntry& name : entry.elements()) {
    require_name(name, {"x", "y", "z", "r", normal_name});
    fixed.push_back(name.text());
  }
}

std::vector<CaseKey<SupportInput>> support_keys() {
  using Key = SupportInput;
  const auto unlisted = [](const Key&) { return std::string(); };
  return {
      leaf("spring", optional, "stiffness in {unit} of a bedding that resists displacement, default {}",
           number(at(&Key::support, &SupportData::spring), not_negative, quantity::bedding())),
      leaf("normal_spring", optional, "the same along the normal at rest alone, default {}",
           number(at(&Key::support, &SupportData::normal_spring), not_negative, quantity::bedding())),
      leaf("damper", optional, "in {unit}: a bedding that resists velocity, default {}",
           number(at(&Key::support, &SupportData::damper), not_negative, quantity::bedding_damping())),
      leaf("normal_damper", optional, "the same along the normal at rest alone, default {}",
           number(at(&Key::support, &SupportData::normal_damper), not_negative, quantity::bedding_damping())),
      leaf<Key>(
          "pressure", optional,
          "pressure on the wall from outside in {unit}, which follows the surface, a table of [time in ms, pressure "
          "in {unit}], or { file = \"NAME.csv\" }",
          {[](const CaseEntry& entry, Key& input) {
             read_table(entry, pressure_kind(), true, input.pressure.emplace());
           },
           unlisted, "", quantity::pressure().unit}),
      leaf<Key>("traction", optional,
                "load in {unit} of area at rest that keeps its direction: a component per direction of the scene, or a "
                "table of [time in ms, components]",
                {read_traction, unlisted, "", quantity::pressure().unit}),
      leaf<Key>("until", optional, "time in {unit} at which a constant pressure and traction fall to 0",
                {[](const CaseEntry& entry, Key& input) { read_until(entry, input.times); }, unlisted, "",
                 quantity::time().unit}),
      leaf<Key>("period", optional, "time in {unit} after which tables begin again",
                {[](const CaseEntry& entry, Key& input) { read_period(entry, input.times); }, unlisted, "",
                 quantity::time().unit}),
      leaf<Key>("fixed", optional,
                "components of the displacement that are zero: of \"x\", \"y\", \"z\", in axisymmetric scenes \"r\", "
                "\"z\", or \"normal\" of a flat surface; wall_ends that no support names are fixed in all",
                {read_fixed, unlisted}),
  };
}

void read_support(const CaseEntry& entry, SupportData& support) {
  SupportInput input;
  read_keys(entry, support_keys(), input);
  const auto refuse_without_load = [&](const char* key) {
    if (entry.has(key) && !input.pressure && input.traction.empty())
      entry.child(key).refuse("there is no load that it could be of", "add pressure or traction");
  };
  refuse_without_load("until");
  refuse_without_load("period");
  const bool tables =
      (input.pressure && input.pressure->is_table) ||
      std::any_of(input.traction.begin(), input.traction.end(), [](const auto& t) { return t.is_table; });
  const auto finished = [&](TableInput& given) {
    given.until = input.times.until;
    if (given.is_table || given.until || !tables) given.period = input.times.period;  // constants beside a table stay
    finish_table(entry, pressure_kind(), given);
    return given.table;
  };
  support = input.support;
  if (input.pressure) support.pressure = finished(*input.pressure);
  for (TableInput& component : input.traction) support.traction.push_back(finished(component));
}

void list_support(const SupportData& support, const std::string& path, std::vector<CaseValue>& values) {
  const auto add = [&](const char* key, const std::string& value) {
    values.push_back({path + "." + key, value, KeyRole::physics});
  };
  add("spring", fmt::format("{}", support.spring));
  add("normal_spring", fmt::format("{}", support.normal_spring));
  add("damper", fmt::format("{}", support.damper));
  add("normal_damper", fmt::format("{}", support.normal_damper));
  const auto add_table = [&](const std::string& key, const PressureTable& table) {
    add(key.c_str(), text_of_table(table));
    if (table.period > 0) add((key + "_period").c_str(), fmt::format("{}", table.period));
  };
  if (support.pressure) add_table("pressure", *support.pressure);
  for (std::size_t k = 0; k < support.traction.size(); ++k)
    add_table("traction_" + std::to_string(k + 1), support.traction[k]);
  if (support.fixed) add("fixed", fmt::format("[{}]", fmt::join(*support.fixed, ", ")));
}

}  // namespace

CaseKey<Case> support_section() {
  std::vector<KeyHelp> help;
  for (const auto& key : support_keys()) help.push_back({"support.SURFACE." + key.name, key.about, key.required});
  return {"support",
          optional,
          "[[support]] with surface = NAME, or [support.NAME]: what holds or loads a surface of the wall from outside",
          [](const CaseEntry& entry, Case& scene) {
            for (const CaseEntry& child : entry.children()) {
              const auto name = child.key().substr(entry.key().size() + 1);
              if (!child.is_section())
                child.refuse("is no section", "begin it with a line [[support]] and a key surface");
              read_support(child, scene.supports[name]);
            }
          },
          [](const Case& scene, const std::string& path, std::vector<CaseValue>& values) {
            for (const auto& [name, support] : scene.supports) list_support(support, path + "." + name, values);
          },
          KeyRole::physics,
          help};
}

CaseKey<Case> prestress_section() {
  const std::vector<CaseKey<PrestressData>> keys = {
      leaf("pressure", true,
           "pressure in {unit} on the inner face that the wall carries in the shape of its mesh, at rest; a fluid "
           "begins "
           "with it",
           number(at(&PrestressData::pressure), any_number, quantity::pressure())),
      leaf<PrestressData>("file", optional, "prestress.h5 of an earlier run, path relative to the case file",
                          {[](const CaseEntry& entry, PrestressData& prestress) {
                             prestress.file = entry.path("path of a prestress.h5");
                           },
                           [](const PrestressData& prestress) { return prestress.file.string(); }},
                          KeyRole::running)};
  return section<PrestressData, Case>(
      "prestress", optional, "a wall that carries a load in the shape of its mesh, without moving", keys,
      [](Case& scene) -> PrestressData& { return scene.prestress.emplace(); },
      [](const Case& scene) { return scene.prestress ? &*scene.prestress : nullptr; });
}

void check_supports(const CaseEntry& whole_case, const Case& scene) {
  if (scene.prestress && !scene.structure)
    whole_case.child("prestress").refuse("stands in a case without a wall", "remove it, or add [structure]");
  if (scene.supports.empty()) return;
  const CaseEntry all = whole_case.child("support");
  if (!scene.structure) all.refuse("stands in a case without a wall", "remove it, or add [structure]");
  const auto names = directions(scene.geometry);
  for (const auto& [surface, support] : scene.supports) {
    const CaseEntry entry = all.child(surface);
    if (!support.traction.empty() && support.traction.size() != names.size())
      entry.child("traction")
          .refuse(fmt::format("has {} components, the scene {} directions", support.traction.size(), names.size()),
                  fmt::format("give one per direction: {}", fmt::join(names, ", ")));
    auto allowed = names;
    allowed.emplace_back(normal_name);
    if (support.fixed)
      for (const auto& name : *support.fixed)
        if (std::find(allowed.begin(), allowed.end(), name) == allowed.end())
          entry.child("fixed").refuse(fmt::format("\"{}\" is no direction of this scene", name),
                                      "give some of " + one_of(allowed));
    const auto check_course = [&](const char* key, const PressureTable& table) {
      if (scene.static_load && table.points.size() > 1)
        entry.child(key).refuse("changes in time, but the case is static", "give one value, without until");
      if (scene.time) check_jumps(entry, table, scene.time->end);
    };
    if (support.pressure) check_course("pressure", *support.pressure);
    for (const auto& component : support.traction) check_course("traction", component);
    if (scene.static_load && (support.damper > 0 || support.normal_damper > 0))
      entry.child(support.damper > 0 ? "damper" : "normal_damper")
          .refuse("resists velocity, which a static case has none of", "remove it, or replace [static] by [time]");
  }
}

}  // namespace fsi
