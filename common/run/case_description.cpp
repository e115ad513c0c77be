#include "run/case_description.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/names.hpp"
#include "base/printable.hpp"
#include "base/quantity.hpp"
#include "case/openings.hpp"
#include "materials/material.hpp"
#include "materials/viscosity_law.hpp"
#include "mesh/group_names.hpp"

namespace fsi {

namespace {

/// "1.5 kPa", or of a table its range: "0 to 1.5 kPa by a table of 3 rows from 0 to 10 ms, every 800 ms".
std::string course(const PressureTable& table, const std::string& unit) {
  if (table.points.empty()) return "0 " + unit;
  const auto by_value = [](const auto& a, const auto& b) { return a.second < b.second; };
  const auto [low, high] = std::minmax_element(table.points.begin(), table.points.end(), by_value);
  if (low->second == high->second) return fmt::format("{:g} {}", low->second, unit);
  return fmt::format("{:g} to {:g} {} by a table of {} rows from {:g} to {:g} ms{}", low->second, high->second, unit,
                     table.points.size(), table.points.front().first, table.points.back().first,
                     table.period > 0 ? fmt::format(", every {:g} ms", table.period) : "");
}

/// \param volume  the unit of what flows: of a plane scene an area
std::string text_of_opening(const OpeningData& opening, const char* volume) {
  if (opening.pressure) return "pressure " + course(*opening.pressure, "kPa");
  if (opening.flow_rate)
    return fmt::format("flow into the fluid of {}, {} profile",
                       course(opening.flow_rate->table, std::string(volume) + "/ms"),
                       inflow_profiles().name_of(opening.flow_rate->profile));
  if (opening.joined) return "joined by the network";
  if (opening.law) return opening.law->make()->description(volume);
  return "free of traction";
}

std::string text_of_support(const SupportData& support) {
  std::vector<std::string> parts;
  const auto add = [&](double value, const char* what, const char* unit) {
    if (value > 0) parts.push_back(fmt::format("{} {:g} {}", what, value, unit));
  };
  if (support.fixed)
    parts.push_back(support.fixed->empty() ? "nothing fixed"
                                           : fmt::format("fixed: {}", fmt::join(*support.fixed, ", ")));
  add(support.spring, "spring", "kPa/mm");
  add(support.normal_spring, "normal spring", "kPa/mm");
  add(support.damper, "damper", "kPa ms/mm");
  add(support.normal_damper, "normal damper", "kPa ms/mm");
  if (support.pressure) parts.push_back("pressure " + course(*support.pressure, "kPa"));
  for (std::size_t k = 0; k < support.traction.size(); ++k)
    parts.push_back(fmt::format("traction {} {}", k + 1, course(support.traction[k], "kPa")));
  return fmt::format("{}", fmt::join(parts, "; "));
}

/// "viscosity 0.0035 kPa ms", or "viscosity of carreau-yasuda (mu0 0.056, ...), 0.0047 kPa ms where one number stands for it".
std::string text_of_viscosity(const FluidData& fluid) {
  if (!fluid.viscosity_model) return fmt::format("viscosity {:g} kPa ms", fluid.viscosity);
  std::vector<std::string> parameters;
  for (const auto& parameter : viscosity_laws().at(fluid.viscosity_model->name).parameters) {
    const auto given = fluid.viscosity_model->values.find(parameter.name);
    const double value = given == fluid.viscosity_model->values.end() ? parameter.standard : given->second;
    parameters.push_back(fmt::format("{} {:g}", parameter.name, value));
  }
  return fmt::format("viscosity of {} ({}), {:g} kPa ms where one number stands for it", fluid.viscosity_model->name,
                     fmt::join(parameters, ", "), fluid.viscosity);
}

}  // namespace

const char* unit_of_volume(const Case& setup) {
  return setup.geometry == Geometry::plane ? "mm^2" : "mm^3";
}

void describe_fluid(const Case& setup, Description& lines) {
  if (setup.fluid)
    lines.push_back(
        {"fluid", fmt::format("density {:g} mg/mm^3, {}", setup.fluid->density, text_of_viscosity(*setup.fluid))});
}

void describe_wall(const Case& setup, Description& lines) {
  if (!setup.structure) return;
  const StructureData& wall = *setup.structure;
  std::string text = fmt::format("density {:g} mg/mm^3", wall.density);
  if (wall.bulk_modulus > 0) text += fmt::format(", bulk modulus {:g} kPa", wall.bulk_modulus);
  if (const auto& g = wall.gravity; g[0] != 0 || g[1] != 0 || g[2] != 0)
    text += fmt::format(", gravity [{:g}, {:g}, {:g}] mm/ms^2", g[0], g[1], g[2]);
  if (!setup.fluid) text += ", alone";
  lines.push_back({"wall", text});
}

std::string text_of_layer(const MaterialData& layer) {
  const MaterialKind& kind = materials().at(layer.material);
  std::string text = layer.material;
  for (const Parameter& parameter : kind.parameters) {
    if (const auto field = layer.fields.find(parameter.name); field != layer.fields.end()) {
      text += fmt::format(", {} from {}", parameter.name, field->second.file.string());
      continue;
    }
    const auto given = layer.values.find(parameter.name);
    if (given == layer.values.end() && (parameter.required || parameter.of_a_set)) continue;
    const double value = given == layer.values.end() ? parameter.standard : given->second;
    text += fmt::format(", {} = {:g}", parameter.name, value);
    if (const std::string unit = parameter.quantity->unit; !unit.empty()) text += " " + unit;
  }
  if (const auto field = layer.fields.find(MaterialData::viscosity_key); field != layer.fields.end())
    text += fmt::format(", viscosity from {}", field->second.file.string());
  else if (layer.viscosity > 0)
    text += fmt::format(", viscosity = {:g} kPa ms", layer.viscosity);
  return text;
}

void describe_openings(const Case& setup, const std::vector<std::string>& surfaces, Description& lines) {
  for (const OpeningData& opening : openings_of(setup))
    if (opening.demanded || contains(surfaces, opening.surface))
      lines.push_back({"opening " + opening.surface, text_of_opening(opening, unit_of_volume(setup))});
  if (setup.load) lines.push_back({"load", "pressure " + course(*setup.load, "kPa") + " on the inner face"});
}

void describe_supports(const Case& setup, const std::vector<std::string>& surfaces, Description& lines) {
  if (!setup.structure) return;
  if (contains(surfaces, group::wall_ends) && setup.supports.count(group::wall_ends) == 0)
    lines.push_back({std::string("support ") + group::wall_ends, "clamped"});
  for (const auto& [surface, support] : setup.supports)
    lines.push_back({"support " + surface, text_of_support(support)});
}

void describe_time(const Case& setup, const std::string& scheme, Description& lines) {
  if (setup.static_load) {
    lines.push_back({"steps", fmt::format("{} steps of the load, at rest", setup.static_load->load_steps)});
    return;
  }
  const TimeData& time = setup.time.value();
  lines.push_back(
      {"steps", time.adaptive
                    ? fmt::format("adaptive to {:g} ms, tolerance {:g}, {}", time.end, time.tolerance, scheme)
                    : fmt::format("{} steps of {:g} ms to {:g} ms, {}", time.steps(), time.step, time.end, scheme)});
}

std::string text_of(const Description& lines) {
  std::size_t width = 0;
  for (const auto& line : lines) width = std::max(width, line.head.size());
  std::string text;
  for (const auto& line : lines) text += fmt::format("{:<{}}  {}\n", printable(line.head), width, printable(line.text));
  return text;
}

}  // namespace fsi
