#include "case/opening_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <vector>

#include "case/key_values.hpp"
#include "case/openings.hpp"
#include "case/table_input.hpp"
#include "fluid/backflow.hpp"

namespace fsi {

namespace {

using presence::optional, presence::required;
constexpr std::array<const char*, 4> sources = {"pressure", "flow_rate", "resistance", "windkessel"};
constexpr std::size_t most_jumps = 100'000;  // each ends a step

/// An opening as it stands in the file.
struct OpeningInput {
  TableInput table;  ///< of the pressure or the flow rate
  InflowProfile profile = InflowProfile::parabolic;
  OutflowLaw resistance, windkessel;
  OpeningConditions conditions;
};

std::vector<CaseKey<OutflowLaw>> windkessel_keys() {
  return {
      leaf("proximal", required, "resistance before the compliance in {unit}",
           number(at(&OutflowLaw::proximal), not_negative, quantity::resistance())),
      leaf("compliance", required, "in {unit}", number(at(&OutflowLaw::compliance), positive, quantity::compliance())),
      leaf("distal", required, "resistance behind the compliance in {unit}",
           number(at(&OutflowLaw::distal), positive, quantity::resistance())),
      leaf("initial_pressure", optional, "of the compliance at the start in {unit}, default {}",
           number(at(&OutflowLaw::initial_pressure), any_number, quantity::pressure())),
      leaf("distal_pressure", optional, "behind the distal resistance in {unit}, default {}",
           number(at(&OutflowLaw::distal_pressure), any_number, quantity::pressure())),
  };
}

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Textbooks' letters for the parts of a Windkessel are nearer to other keys than to those that they mean.
void refuse_symbols(const CaseEntry& windkessel) {
  struct Symbol {
    const char* letters;
    const char* key;
  };
  constexpr Symbol symbols[] = {{"Rp", "proximal"},        {"R1", "proximal"},        {"Rc", "proximal"},
                                {"Z", "proximal"},         {"Zc", "proximal"},        {"C", "compliance"},
                                {"Rd", "distal"},          {"R2", "distal"},          {"R", "distal"},
                                {"Pd", "distal_pressure"}, {"P0", "initial_pressure"}};
  if (!windkessel.is_section()) return;
  for (const auto& child : windkessel.children()) {
    std::string name = child.key().substr(windkessel.key().size() + 1);
    name.erase(std::remove(name.begin(), name.end(), '_'), name.end());
    for (const Symbol& symbol : symbols)
      if (lower_case(name) == lower_case(symbol.letters))
        child.refuse("unknown key", std::string("did you mean ") + symbol.key +
                                        "? There are proximal (Rp), compliance (C), distal (Rd), initial_pressure and "
                                        "distal_pressure");
  }
}

KeyValue<OpeningInput> table_of(const TableKind& kind) {
  return {[&kind](const CaseEntry& entry, OpeningInput& input) { read_table(entry, kind, true, input.table); },
          [](const OpeningInput&) { return std::string(); }, "", kind.values.unit};
}

/// Listed by list_openings(), as they are after reading.
std::vector<CaseKey<OpeningInput>> keys_of_opening(Geometry geometry = Geometry::three_dimensional) {
  const auto unlisted = [](const OpeningInput&) { return std::string(); };
  return {
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
      leaf("resistance", optional, "pressure over outward flow in {unit}, in place of a pressure",
           number(at(&OpeningInput::resistance, &OutflowLaw::proximal), not_negative, quantity::resistance())),
      leaf("distal_pressure", optional, "behind the resistance in {unit}, default {}",
           number(at(&OpeningInput::resistance, &OutflowLaw::distal_pressure), any_number, quantity::pressure())),
      leaf("backflow", optional,
           "factor of the stabilisation against fluid that enters where its flow is not given, 0: none; default 0.5, "
           "which lets no kinetic energy in",
           number(at(&OpeningInput::conditions, &OpeningConditions::backflow), not_negative)),
      section<OutflowLaw, OpeningInput>(
          "windkessel", optional, "proximal resistance, compliance and distal resistance, in place of a pressure",
          windkessel_keys(), [](OpeningInput& input) -> OutflowLaw& { return input.windkessel; },
          [](const OpeningInput& input) { return &input.windkessel; }),
  };
}

/// One source at most, and nothing that belongs to another.
void check_sources(const CaseEntry& entry) {
  std::string source;
  for (const char* name : sources) {
    if (!entry.has(name)) continue;
    if (!source.empty())
      entry.child(name).refuse("stands beside " + source, "keep one of them: what happens here has one cause");
    source = name;
  }
  const auto belongs = [&](const char* key, bool given, const std::string& to) {
    if (entry.has(key) && !given) entry.child(key).refuse("belongs to " + to, "remove it, or give " + to + " as well");
  };
  const bool table = source == "pressure" || source == "flow_rate";
  belongs("until", table, "pressure or flow_rate");
  belongs("period", table, "pressure or flow_rate");
  belongs("profile", source == "flow_rate", "flow_rate");
  belongs("distal_pressure", source == "resistance", source == "windkessel" ? "windkessel" : "resistance");
}

OpeningConditions read_opening(const CaseEntry& entry, Geometry geometry) {
  OpeningInput input;
  if (entry.key().find(',') != std::string::npos)
    entry.refuse("has a comma in its name, which openings.csv could not show", "give the surface a name without");
  if (!entry.is_section())
    entry.refuse("is no section", "write [[opening]] with surface = \"" + entry.key().substr(8) + "\"");
  if (entry.has("windkessel") && entry.has("distal_pressure"))
    entry.child("distal_pressure").refuse("stands beside windkessel", "put it into the section windkessel");
  if (entry.has("windkessel")) refuse_symbols(entry.child("windkessel"));
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
  } else if (entry.has("resistance")) {
    conditions.outflow_law = input.resistance;
  } else if (entry.has("windkessel")) {
    conditions.outflow_law = input.windkessel;
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
    const auto add = [&](const char* key, double value) {
      values.push_back({here + "." + key, fmt::format("{}", value), KeyRole::physics});
    };
    if (conditions.pressure) list_table(here + ".pressure", *conditions.pressure, values);
    if (conditions.flow_rate) {
      list_table(here + ".flow_rate", conditions.flow_rate->table, values);
      values.push_back({here + ".profile", inflow_profiles().name_of(conditions.flow_rate->profile), KeyRole::physics});
    }
    if (const auto& law = conditions.outflow_law; law && law->stores()) {
      list_keys(windkessel_keys(), *law, here + ".windkessel", values);
    } else if (law) {
      add("resistance", law->proximal);
      add("distal_pressure", law->distal_pressure);
    }
    if (!conditions.flow_rate) add("backflow", conditions.backflow.value_or(BackflowTraction::standard));
    if (!conditions.pressure && !conditions.flow_rate && !conditions.outflow_law)
      values.push_back({here, "free of traction", KeyRole::physics});
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
  return {
      "opening",
      optional,
      "a list [[opening]]: each a surface that fluid passes, with pressure, flow_rate, resistance or windkessel, or "
      "free of traction",
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
  if (!scene.time) return;
  for (const auto& [surface, conditions] : scene.openings) {
    const PressureTable* table = conditions.pressure    ? &*conditions.pressure
                                 : conditions.flow_rate ? &conditions.flow_rate->table
                                                        : nullptr;
    if (table == nullptr || table->period == 0) continue;
    const double jumps = static_cast<double>(table->jumps_in_period()) * scene.time->end / table->period;
    if (jumps > static_cast<double>(most_jumps))
      openings.child(surface).child("period").refuse(
          fmt::format("the table would jump {:.3g} times in {} ms, and end a step each time", jumps, scene.time->end),
          "give a longer period, or a table without jumps whose last value is its first");
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
