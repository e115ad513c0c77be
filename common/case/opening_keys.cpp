#include "case/opening_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/names.hpp"
#include "case/key_values.hpp"
#include "case/openings.hpp"
#include "case/parameter_keys.hpp"
#include "case/table_input.hpp"
#include "fluid/backflow.hpp"

namespace fsi {

namespace {

using presence::optional, presence::required;
constexpr const char* in_place = ", in place of a pressure";

/// The conditions of which an opening has at most one.
std::vector<std::string> sources() {
  std::vector<std::string> names{"pressure", "flow_rate"};
  for (const auto& [name, kind] : opening_laws().rows()) names.push_back(name);
  return names;
}

/// An opening as it stands in the file.
struct OpeningInput {
  TableInput table;  ///< of the pressure or the flow rate
  InflowProfile profile = InflowProfile::parabolic;
  ParameterValues law;
  OpeningConditions conditions;
};

/// The keys of a law's section.
std::vector<CaseKey<ParameterValues>> keys_of_law(const OpeningLawKind& kind) {
  const Place<ParameterValues, ParameterValues> all{[](ParameterValues& values) -> ParameterValues& { return values; }};
  std::vector<CaseKey<ParameterValues>> keys;
  for (const auto& p : kind.parameters) keys.push_back(parameter_key(p, all));
  return keys;
}

/// By their spelling, textbooks' letters for the parts of a Windkessel are nearer to other keys than to those they
/// mean.
void refuse_letters(const CaseEntry& law, const OpeningLawKind& kind) {
  if (!law.is_section()) return;
  std::string named;  // all keys, required ones with their letter
  for (const auto& p : kind.parameters) {
    const auto letter =
        std::find_if(kind.letters.begin(), kind.letters.end(), [&](const auto& row) { return row.second == p.name; });
    if (!named.empty()) named += &p == &kind.parameters.back() ? " and " : ", ";
    named += (p.required && letter != kind.letters.end() ? p.name + " (" + letter->first + ")" : p.name);
  }
  for (const auto& child : law.children()) {
    std::string name = child.key().substr(law.key().size() + 1);
    name.erase(std::remove(name.begin(), name.end(), '_'), name.end());
    for (const auto& [letters, parameter] : kind.letters)
      if (lower_case(name) == lower_case(letters))
        child.refuse("unknown key", "did you mean " + parameter + "? There are " + named);
  }
}

KeyValue<OpeningInput> table_of(const TableKind& kind) {
  return {[&kind](const CaseEntry& entry, OpeningInput& input) { read_table(entry, kind, true, input.table); },
          [](const OpeningInput&) { return std::string(); }, "", kind.values.unit};
}

/// Their values are listed by list_openings().
std::vector<CaseKey<OpeningInput>> keys_of_opening(Geometry geometry = Geometry::three_dimensional) {
  const auto unlisted = [](const OpeningInput&) { return std::string(); };
  std::vector<CaseKey<OpeningInput>> keys{
      leaf<OpeningInput>("pressure", optional,
                         "on the fluid in {unit}: a number, a table of [time in ms, pressure], or { file = "
                         "\"NAME.csv\" }, path relative to the case file",
                         table_of(pressure_kind())),
      leaf<OpeningInput>("flow_rate", optional,
                         "into the fluid in {unit}, in place of a pressure: a number, a table or a file likewise",
                         table_of(flow_rate_kind(geometry == Geometry::plane))),
      leaf<OpeningInput>(
          "until", optional, "time in ms at which a constant pressure or flow rate falls to 0",
          {[](const CaseEntry& entry, OpeningInput& input) { read_until(entry, input.table); }, unlisted}),
      leaf<OpeningInput>(
          "period", optional, "in ms, with which the table repeats itself; without it the last value stays",
          {[](const CaseEntry& entry, OpeningInput& input) { read_period(entry, input.table); }, unlisted}),
      leaf("profile", optional, "of a flow rate's velocity: {}",
           name_from(at(&OpeningInput::profile), inflow_profiles())),
  };
  for (const auto& [name, kind] : opening_laws().rows())
    for (std::size_t i = 0; !kind.has_section() && i < kind.parameters.size(); ++i) {
      keys.push_back(parameter_key(kind.parameters[i], at(&OpeningInput::law)));
      keys.back().required = optional;
      if (i == 0) keys.back().about += in_place;
    }
  keys.push_back(
      leaf("backflow", optional,
           "factor of the stabilisation against fluid that enters where its flow is not given, 0: none; default 0.5, "
           "which lets no kinetic energy in",
           number(at(&OpeningInput::conditions, &OpeningConditions::backflow), not_negative)));
  for (const auto& [name, kind] : opening_laws().rows())
    if (kind.has_section())
      keys.push_back(section<ParameterValues, OpeningInput>(
          name, optional, kind.about + std::string(in_place), keys_of_law(kind),
          [](OpeningInput& input) -> ParameterValues& { return input.law; },
          [](const OpeningInput& input) { return &input.law; }));
  return keys;
}

/// Refuses a second source, and keys of another one.
void check_sources(const CaseEntry& entry) {
  std::string source;
  for (const std::string& name : sources()) {
    if (!entry.has(name)) continue;
    if (!source.empty())
      entry.child(name).refuse("stands beside " + source, "keep one of them: what happens here has one cause");
    source = name;
  }
  const auto belongs = [&](const std::string& key, bool given, const std::string& to) {
    if (entry.has(key) && !given) entry.child(key).refuse("belongs to " + to, "remove it, or give " + to + " as well");
  };
  const bool table = source == "pressure" || source == "flow_rate";
  belongs("until", table, "pressure or flow_rate");
  belongs("period", table, "pressure or flow_rate");
  belongs("profile", source == "flow_rate", "flow_rate");
  for (const auto& [name, kind] : opening_laws().rows())
    for (const auto& p : kind.parameters)
      if (!kind.has_section() && p.name != name) belongs(p.name, source == name, name);
}

OpeningConditions read_opening(const CaseEntry& entry, Geometry geometry) {
  OpeningInput input;
  if (entry.key().find(',') != std::string::npos)
    entry.refuse("has a comma in its name, which openings.csv could not show", "give the surface a name without");
  if (!entry.is_section())
    entry.refuse("is no section", "write [[opening]] with surface = \"" + entry.key().substr(8) + "\"");
  for (const auto& [name, kind] : opening_laws().rows()) {
    if (!kind.has_section() || !entry.has(name)) continue;
    for (const auto& p : kind.parameters)
      if (entry.has(p.name)) entry.child(p.name).refuse("stands beside " + name, "put it into the section " + name);
    refuse_letters(entry.child(name), kind);
  }
  read_keys(entry, keys_of_opening(geometry), input);
  check_sources(entry);
  OpeningConditions& conditions = input.conditions;
  if (entry.has("flow_rate") && entry.has("backflow"))
    entry.child("backflow").refuse("stands beside flow_rate, which says what enters", "remove it");
  if (entry.has("pressure")) {
    finish_table(entry, pressure_kind(), input.table);
    conditions.pressure = input.table.table;
  } else if (entry.has("flow_rate")) {
    finish_table(entry, flow_rate_kind(), input.table);
    if (input.profile == InflowProfile::womersley && input.table.table.period == 0)
      entry.child("profile").refuse("\"womersley\" is the profile of a flow rate that repeats itself",
                                    "give period, or profile = \"parabolic\"");
    if (input.profile == InflowProfile::womersley && input.table.table.jumps_in_period() > 0)
      entry.child("profile").refuse("\"womersley\" stands beside a flow rate that jumps within its period",
                                    "give a table without jumps whose last value is its first, or profile = "
                                    "\"parabolic\"");
    conditions.flow_rate = FlowRateData{input.table.table, input.profile};
  } else {
    for (const auto& [name, kind] : opening_laws().rows())
      if (entry.has(name)) conditions.law = OpeningLawData{name, input.law};
  }
  return conditions;
}

void list_table(const std::string& path, const PressureTable& table, std::vector<CaseValue>& values) {
  values.push_back({path, text_of_table(table), KeyRole::physics});
  if (table.period > 0) values.push_back({path + ".period", fmt::format("{}", table.period), KeyRole::physics});
}

void list_openings(const Case& scene, const std::string& path, std::vector<CaseValue>& values) {
  for (const auto& [surface, conditions] : scene.openings) {
    const std::string here = path + "." + surface;
    if (conditions.pressure) list_table(here + ".pressure", *conditions.pressure, values);
    if (conditions.flow_rate) {
      list_table(here + ".flow_rate", conditions.flow_rate->table, values);
      values.push_back({here + ".profile", inflow_profiles().name_of(conditions.flow_rate->profile), KeyRole::physics});
    }
    if (const auto& law = conditions.law) {
      const OpeningLawKind& kind = opening_laws().at(law->name);
      list_keys(keys_of_law(kind), law->values, kind.has_section() ? here + "." + law->name : here, values);
    }
    if (!conditions.flow_rate)
      values.push_back({here + ".backflow", fmt::format("{}", conditions.backflow.value_or(BackflowTraction::standard)),
                        KeyRole::physics});
    if (conditions.is_free()) values.push_back({here, "free of traction", KeyRole::physics});
  }
}

std::vector<KeyHelp> help() {
  std::vector<KeyHelp> lines{
      {"opening.surface", "NAME in what follows: a surface group of the mesh; said within [[opening]]", required}};
  for (const auto& key : keys_of_opening()) {
    if (key.below.empty()) lines.push_back({"opening.NAME." + key.name, key.about, key.required});
    for (const auto& below : key.below) lines.push_back({"opening.NAME." + below.path, below.about, false});
  }
  return lines;
}

}  // namespace

CaseKey<Case> opening_key() {
  return {"opening",
          optional,
          "a list [[opening]]: each a surface that fluid passes, with " + one_of(sources()) + ", or free of traction",
          [](const CaseEntry& entry, Case& scene) {
            for (const auto& child : entry.children())
              scene.openings[child.key().substr(entry.key().size() + 1)] = read_opening(child, scene.geometry);
          },
          list_openings,
          KeyRole::physics,
          help()};
}

void check_openings(const CaseEntry& whole_case, const Case& scene) {
  if (scene.openings.empty()) return;
  const CaseEntry openings = whole_case.child("opening");
  if (!scene.fluid) openings.refuse("stands in a case without fluid", "add [fluid], or give the wall a [load]");
  if (scene.inlet && scene.openings.count(group::inlet) > 0)
    openings.child(group::inlet).refuse("stands beside [inlet]", "keep one of the two");
  const CaseEntry fluid = whole_case.child("fluid");
  if (!scene.fluid->outlet && fluid.has("outlet") && scene.openings.count(group::outlet) > 0)
    openings.child(group::outlet).refuse("stands beside fluid.outlet = false", "keep one of the two");
  if (!scene.time) return;
  for (const auto& [surface, conditions] : scene.openings) {
    const PressureTable* table = conditions.pressure    ? &*conditions.pressure
                                 : conditions.flow_rate ? &conditions.flow_rate->table
                                                        : nullptr;
    if (table != nullptr) check_jumps(openings.child(surface), *table, scene.time->end);
  }
}

void check_closed(const CaseEntry& whole_case, const Case& scene) {
  if (!scene.fluid || !scene.fluid->closed) return;
  const CaseEntry fluid = whole_case.child("fluid"), closed = fluid.child("closed");
  for (const auto& name : *scene.fluid->closed) {
    const bool inlet = name == group::inlet && scene.inlet;
    if (inlet || scene.openings.count(name) > 0)
      closed.refuse(fmt::format("names \"{}\", which {} opens", name, inlet ? "[inlet]" : "an [[opening]]"),
                    "keep one of the two");
    if (name == group::outlet && fluid.has("outlet") && fluid.child("outlet").boolean())
      closed.refuse("names \"outlet\" beside outlet = true", "keep one of the two");
  }
}

}  // namespace fsi
