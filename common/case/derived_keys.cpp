#include "case/derived_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <string>

#include "case/key_values.hpp"
#include "case/scene_period.hpp"

namespace fsi {

namespace {

using presence::optional, presence::required;

/// A name that may stand in a column of a table.
void require_plain(const CaseEntry& entry, const std::string& name) {
  const auto odd = [](unsigned char c) { return c == ',' || c == '"' || c == '\'' || c < ' '; };
  if (name.empty() || std::any_of(name.begin(), name.end(), odd) || name.size() > 100 || name.front() == ' ' ||
      name.back() == ' ')
    entry.refuse_value("cannot stand in a table",
                       "give up to 100 letters, digits and signs other than commas and quotes");
}

std::vector<std::string> surface_names(const CaseEntry& entry) {
  std::vector<std::string> names;
  for (const auto& element : entry.elements()) {
    const std::string name = element.text();
    require_plain(element, name);
    if (std::find(names.begin(), names.end(), name) != names.end())
      element.refuse_value("is named twice", "name each surface once");
    names.push_back(name);
  }
  return names;
}

std::string listed(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

std::vector<CaseKey<std::vector<std::string>>> force_keys() {
  using Names = std::vector<std::string>;
  return {leaf<Names>("surfaces", required, "surfaces that the force is on, together",
                      {[](const CaseEntry& entry, Names& names) {
                         names = surface_names(entry);
                         if (names.empty()) entry.refuse("names no surface", "give at least one");
                       },
                       listed})};
}

void read_forces(const CaseEntry& entry, OutputData& output) {
  for (const auto& child : entry.children()) {
    const auto name = child.key().substr(entry.key().size() + 1);
    require_plain(child, name);
    if (std::find(output.derived.surfaces.begin(), output.derived.surfaces.end(), name) !=
        output.derived.surfaces.end())
      child.refuse("\"" + name + "\" is a name in output.surfaces, too", "give it another one");
    read_keys(child, force_keys(), output.derived.forces[name]);
  }
}

void list_forces(const OutputData& output, const std::string& path, std::vector<CaseValue>& values) {
  for (const auto& [name, surfaces] : output.derived.forces) {
    list_keys(force_keys(), surfaces, path + "." + name, values);
    values.back().role = KeyRole::running;
  }
}

}  // namespace

std::vector<CaseKey<OutputData>> derived_output_keys() {
  using D = DerivedOutput;
  return {
      leaf<OutputData>(
          "surfaces", optional,
          "surfaces whose forces are in surfaces.csv, by name; walls: all that the fluid sticks to; "
          "interface: that of fluid and wall",
          {[](const CaseEntry& entry, OutputData& output) { output.derived.surfaces = surface_names(entry); },
           [](const OutputData& output) { return listed(output.derived.surfaces); }}),
      {"forces",
       optional,
       "a section [output.forces.NAME] per force on several surfaces together",
       read_forces,
       list_forces,
       KeyRole::running,
       {{"forces.NAME.surfaces", "surfaces that the force is on, together", required}}},
      leaf("statistics", optional,
           "averages of the wall shear stress over each period, as fields of fields.h5: tawss, osi, rrt; default {}",
           flag(at(&OutputData::derived, &D::statistics))),
      leaf("period", optional,
           "of statistics, in {unit}: from 0 to it, from there to its double, and so on; without it that of the "
           "openings "
           "that are periodic",
           number(at(&OutputData::derived, &D::period), positive, quantity::time())),
      leaf("error_indicator", optional,
           "where the mesh is too coarse, as fields of cells in fields.h5: velocity_error, displacement_error, "
           "pressure_error, and their means over time; default {}",
           flag(at(&OutputData::derived, &D::error_indicator))),
  };
}

namespace {

/// Fields of stresses know the elastic law alone.
void warn_of_viscous_layers(const CaseEntry& fields, const std::string& field, const StructureData& structure) {
  const auto resists_rates = [](const auto& layer) {
    return layer.second.viscosity > 0 || !layer.second.maxwell.empty();
  };
  const auto layer = std::find_if(structure.layers.begin(), structure.layers.end(), resists_rates);
  if (layer == structure.layers.end()) return;
  fields.warn(
      fmt::format("\"{}\" is the stress of the elastic law: it lacks what viscosity and Maxwell branches add in "
                  "layer {}",
                  field, layer->first),
      "take it as that of a wall at rest, or leave it out");
}

}  // namespace

void check_derived_output(const CaseEntry& whole_case, Case& scene) {
  auto& wanted = scene.output.derived;
  if (wanted.error_indicator && scene.output.every == 0)
    whole_case.child("output")
        .child("error_indicator")
        .refuse("asks for fields, and output.every = 0 writes none", "give another every");
  if (!wanted.statistics && !wanted.period && scene.output.fields == standard_output_fields()) return;
  const CaseEntry output = whole_case.child("output");
  const auto has = [&](const std::vector<std::string>& names) {
    return std::find_first_of(scene.output.fields.begin(), scene.output.fields.end(), names.begin(), names.end());
  };
  if (const auto found = has({"wall_shear_stress"}); found != scene.output.fields.end() && !scene.fluid)
    output.child("fields").refuse("\"" + *found + "\" is of a fluid, and the scene has none", "leave it out");
  if (const auto found = has({"cauchy_stress", "principal_stress", "von_mises_stress", "fibre_stress", "thickness"});
      found != scene.output.fields.end() && !scene.structure)
    output.child("fields").refuse("\"" + *found + "\" is of a wall, and the scene has none", "leave it out");
  if (const auto found = has({"cauchy_stress", "principal_stress", "von_mises_stress", "fibre_stress"});
      found != scene.output.fields.end() && scene.time)
    warn_of_viscous_layers(output.child("fields"), *found, *scene.structure);
  if (wanted.period && !wanted.statistics)
    output.child("period").refuse("belongs to statistics", "set output.statistics = true as well, or leave it out");
  if (!wanted.statistics) return;
  const CaseEntry statistics = output.child("statistics");
  if (!scene.fluid || !scene.time)
    statistics.refuse("are of a fluid in time, and the scene has none", "leave them out");
  if (!wanted.period) wanted.period = require_period(statistics, scene, "output.period");
  if (scene.output.every == 0) statistics.refuse("are fields, and output.every = 0 writes none", "give another every");
  if (*wanted.period > scene.time->end)
    output.child("period").warn("is longer than the run: no period comes to its end",
                                fmt::format("give at most time.end, {:g}", scene.time->end));
}

}  // namespace fsi
