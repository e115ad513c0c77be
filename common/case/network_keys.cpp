#include "case/network_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/names.hpp"
#include "case/key_values.hpp"
#include "case/network_data.hpp"
#include "case/openings.hpp"
#include "case/parameter_keys.hpp"
#include "case/table_input.hpp"
#include "mesh/group_names.hpp"
#include "network/element_kinds.hpp"
#include "network/network_checks.hpp"
#include "network/network_quantities.hpp"

namespace fsi {

namespace {

using presence::optional, presence::required;

/// An element as it stands in the file.
struct ElementInput {
  NetworkElementData data;
  TableInput table;
};

const TableKind* table_kind(ElementCourse course, Geometry geometry = Geometry::three_dimensional) {
  static const TableKind elastance{"elastance", "elastances", quantity::elastance(), ColumnKind::elastance};
  switch (course) {
    case ElementCourse::pressure:
      return &pressure_kind();
    case ElementCourse::flow:
      return &flow_rate_kind(geometry == Geometry::plane);
    case ElementCourse::elastance:
      return &elastance;
    case ElementCourse::none:
      break;
  }
  return nullptr;
}

KeyValue<ElementInput> ends() {
  return {[](const CaseEntry& entry, ElementInput& input) {
            const auto names = entry.is_array() ? entry.elements() : std::vector<CaseEntry>();
            if (names.size() != 2) entry.refuse("is no pair of nodes", "give [\"FROM\", \"TO\"]");
            for (const CaseEntry& name : names)
              if (name.line().empty() || name.line().find(',') != std::string::npos)
                name.refuse_value("is no name of a node", "give a name without comma");
            input.data.from = names[0].line();
            input.data.to = names[1].line();
          },
          [](const ElementInput& input) { return fmt::format("[{}, {}]", input.data.from, input.data.to); }};
}

std::vector<CaseKey<ElementInput>> keys_of_kind(const NetworkElementKind& kind,
                                                Geometry geometry = Geometry::three_dimensional) {
  std::vector<CaseKey<ElementInput>> keys;
  const Place<ElementInput, ParameterValues> values{
      [](ElementInput& input) -> ParameterValues& { return input.data.values; }};
  for (const auto& parameter : kind.parameters) keys.push_back(parameter_key(parameter, values));
  const TableKind* table = table_kind(kind.course, geometry);
  if (table == nullptr) return keys;
  const auto unlisted = [](const ElementInput&) { return std::string(); };  // list_elements() does
  keys.push_back(leaf<ElementInput>(
      table->key, required,
      "in {unit}: a number, a table of [time in ms, value], or { file = \"NAME.csv\" }, path relative to the case file",
      {[table](const CaseEntry& entry, ElementInput& input) { read_table(entry, *table, true, input.table); }, unlisted,
       "", table->values.unit}));
  keys.push_back(leaf<ElementInput>(
      "period", optional, "in ms, with which the table repeats itself; without it the last value stays",
      {[](const CaseEntry& entry, ElementInput& input) { read_period(entry, input.table); }, unlisted}));
  return keys;
}

/// The keys of every element.
std::vector<CaseKey<ElementInput>> common_keys() {
  const Place<ElementInput, std::string> kind{[](ElementInput& input) -> std::string& { return input.data.kind; }};
  return {
      leaf("kind", required, one_of(network_element_kinds().names()), name_from(kind, network_element_kinds().names())),
      leaf<ElementInput>(
          "between", required,
          "[\"FROM\", \"TO\"], two nodes: surfaces with an [[opening]], \"ground\", or names of your own; "
          "flows are positive from the first to the second",
          ends())};
}

NetworkElementData read_element(const CaseEntry& entry, Geometry geometry) {
  ElementInput input;
  if (!entry.is_section()) entry.refuse("is no section", "write [[network.element]] with name, kind and between");
  input.data.name = entry.key().substr(std::string("network.element.").size());
  if (input.data.name.find(',') != std::string::npos)
    entry.refuse("has a comma in its name, which network.csv could not show", "give it a name without");
  std::vector<CaseKey<ElementInput>> keys = common_keys();
  if (!entry.has("kind")) entry.refuse_missing("kind", "add it (" + keys.front().about + ")");
  keys.front().read(entry.child("kind", keys.front().about), input);
  const NetworkElementKind& kind = network_element_kinds().at(input.data.kind);
  for (auto& key : keys_of_kind(kind, geometry)) keys.push_back(std::move(key));
  read_keys(entry, keys, input);
  if (const TableKind* table = table_kind(kind.course, geometry)) {
    finish_table(entry, *table, input.table);
    input.data.course = input.table.table;
    if (!input.table.table.jumps().empty())
      entry.child(table->key)
          .refuse("jumps, also where a period ends with another value than it begins with",
                  "let it change within a time that a few steps resolve");
    for (const auto& [time, value] : input.table.table.points)
      if (kind.course == ElementCourse::elastance && !(value > 0))
        entry.child(table->key)
            .refuse(fmt::format("is {:g} at {:g} ms, which is not positive", value, time), "give elastances > 0");
  }
  return input.data;
}

NetworkData read_network(const CaseEntry& entry, Geometry geometry) {
  NetworkData network;
  const std::vector<std::string> known{"ground_pressure", "element"};
  refuse_unknown_keys(entry, known);
  if (!entry.has("element"))
    entry.refuse_missing("element", "add [[network.element]] with name, kind and between, one for each element");
  if (entry.has("ground_pressure"))
    network.ground_pressure = entry.child("ground_pressure", "in kPa").number(quantity::pressure());
  for (const CaseEntry& child : entry.child("element").children())
    network.elements.push_back(read_element(child, geometry));
  if (network.elements.empty()) entry.child("element").refuse("is empty", "add [[network.element]]");
  return network;
}

void list_network(const Case& scene, const std::string& path, std::vector<CaseValue>& values) {
  if (!scene.network) return;
  values.push_back({path + ".ground_pressure", fmt::format("{}", scene.network->ground_pressure), KeyRole::physics});
  for (const NetworkElementData& element : scene.network->elements) {
    const std::string here = path + ".element." + element.name;
    const NetworkElementKind& kind = network_element_kinds().at(element.kind);
    const ElementInput input{element, {}};
    list_keys(common_keys(), input, here, values);
    if (element.course) {
      const std::string key = here + "." + table_kind(kind.course)->key;
      values.push_back({key, text_of_table(*element.course), KeyRole::physics});
      if (element.course->period > 0)
        values.push_back({here + ".period", fmt::format("{}", element.course->period), KeyRole::physics});
    }
    std::vector<CaseValue> own;
    list_keys(keys_of_kind(kind), input, here, own);
    for (CaseValue& value : own)
      if (!value.value.empty()) values.push_back(std::move(value));
  }
}

/// Each key once, with its meaning for each kind that has it.
std::vector<KeyHelp> help_of_network() {
  std::vector<KeyHelp> lines{
      {"network.ground_pressure", "of the node \"ground\" in kPa, default 0", optional},
      {"network.element.name", "NAME in what follows; said within [[network.element]]", required}};
  for (const auto& key : common_keys()) lines.push_back({"network.element.NAME." + key.name, key.about, key.required});
  const std::size_t first = lines.size();
  for (const auto& [name, kind] : network_element_kinds().rows())
    for (const auto& key : keys_of_kind(kind)) {
      const std::string path = "network.element.NAME." + key.name;
      const auto known = std::find_if(lines.begin() + static_cast<std::ptrdiff_t>(first), lines.end(),
                                      [&](const KeyHelp& line) { return line.path == path; });
      const std::string about = name + ": " + key.about;
      if (known == lines.end())
        lines.push_back({path, about, false});
      else
        known->about += "; " + about;
    }
  return lines;
}

/// Marks the openings that are nodes of the network, by their names.
void join_openings(const CaseEntry& whole_case, Case& scene) {
  std::vector<std::string> known;
  for (const auto& [surface, conditions] : scene.openings) known.push_back(surface);
  bool any = false;
  for (const NetworkElementData& element : scene.network->elements)
    for (const std::string& node : {element.from, element.to}) {
      const CaseEntry between = whole_case.child("network").child("element").child(element.name).child("between");
      const auto opening = scene.openings.find(node);
      if (opening != scene.openings.end()) {
        if (!opening->second.joined && !opening->second.is_free())
          whole_case.child("opening").child(node).refuse(
              fmt::format("has a condition of its own, and network.element.{} joins it, which gives its pressure",
                          element.name),
              "keep one of the two");
        opening->second.joined = any = true;
      } else if (node == group::inlet && scene.inlet) {
        between.refuse("joins the inlet, whose pressure [inlet] gives",
                       "replace [inlet] by an [[opening]] without pressure");
      } else if (node == group::outlet && scene.fluid->outlet) {
        between.refuse(
            "joins the node \"outlet\", which has no [[opening]]: the surface of that name would be free of "
            "traction",
            "add [[opening]] with surface = \"outlet\", or name the node otherwise");
      }
    }
  if (!any)
    whole_case.child("network").refuse(
        "joins no opening: none of its nodes has the name of one",
        known.empty() ? "add an [[opening]] whose surface is a node" : "there are the openings " + one_of(known));
}

}  // namespace

CaseKey<Case> network_key() {
  return {"network",
          optional,
          "lumped elements behind openings: a list [[network.element]], joined at nodes by name",
          [](const CaseEntry& entry, Case& scene) {
            scene.network = std::make_shared<const NetworkData>(read_network(entry, scene.geometry));
          },
          list_network,
          KeyRole::physics,
          help_of_network()};
}

void join_network(const CaseEntry& whole_case, Case& scene) {
  if (!scene.network) return;
  const CaseEntry network = whole_case.child("network");
  if (!scene.fluid) network.refuse("stands in a case without fluid", "add [fluid], or remove it");
  join_openings(whole_case, scene);
  scene.linear.fast.exact = true;
  if (!scene.time) return;
  if (scene.time->start == StartOfOpenings::lumped)
    whole_case.child("time").child("start").refuse(
        "\"lumped\" is for openings by themselves, and [network] joins some, maybe with valves",
        "leave it out and give the elements initial_pressure and initial_volume");
  const std::shared_ptr<const Network> made = make_network(scene);
  if (const auto fault = fault_of(*made, scene.time->step > 0 ? scene.time->step : 1.0)) {
    const CaseEntry at = fault->element.empty() ? network : network.child("element").child(fault->element);
    at.child(fault->key).refuse(fault->problem, fault->remedy);
  }
  network.remark(text_of_network(*made, scene.geometry == Geometry::plane ? "mm^2" : "mm^3"));
}

}  // namespace fsi
