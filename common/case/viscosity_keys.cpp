#include "case/viscosity_keys.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "base/names.hpp"
#include "case/key_values.hpp"
#include "case/parameter_keys.hpp"
#include "materials/viscosity_law.hpp"

namespace fsi {

namespace {

using presence::optional, presence::required;
constexpr const char* newtonian = "newtonian";

/// The names of the laws, after that of a constant viscosity.
std::vector<std::string> model_names() {
  std::vector<std::string> names{newtonian};
  for (const auto& name : viscosity_laws().names()) names.push_back(name);
  return names;
}

std::string about_name() {
  return "the law of the viscosity: " + marked(model_names(), newtonian);
}

/// The keys of a law's table: its name and its parameters.
std::vector<CaseKey<ViscosityData>> keys_of_model(const ViscosityKind& kind) {
  std::vector<CaseKey<ViscosityData>> keys = {leaf("name", required, about_name(), any_text(at(&ViscosityData::name)))};
  for (const auto& p : kind.parameters) keys.push_back(parameter_key(p, at(&ViscosityData::values)));
  return keys;
}

/// A parameter of another law is no misspelling: the message says what this one takes.
void refuse_others(const CaseEntry& entry, const std::string& name, const ViscosityKind* kind) {
  for (const auto& child : entry.children()) {
    const auto key = child.key().substr(entry.key().size() + 1);
    if (key == "name" || (kind != nullptr && kind->find(key) != nullptr)) continue;
    std::vector<std::string> own;
    for (std::size_t i = 0; kind != nullptr && i < kind->parameters.size(); ++i)
      own.push_back(kind->parameters[i].name);
    const std::string takes = kind != nullptr ? one_of(own) : "none: fluid.viscosity is all";
    for (const auto& [other, other_kind] : viscosity_laws().rows())
      if (other_kind.find(key) != nullptr)
        child.refuse("is no parameter of " + name + " but of " + other, "remove it (" + name + " takes " + takes + ")");
    if (kind == nullptr) child.refuse("unknown key", "remove it (" + name + " takes " + takes + ")");
  }
}

void read_model(const CaseEntry& entry, FluidData& fluid) {
  const auto names = model_names();
  if (!entry.is_section())
    entry.refuse("is no table",
                 "give one with the law's name and parameters, as { name = \"casson\", ... }, or leave "
                 "it out");
  if (!entry.has("name")) {
    // A misspelt `name` explains better why there is none.
    for (const auto& child : entry.children())
      if (edit_distance(child.key(), entry.key() + ".name") <= 1)
        child.refuse("unknown key", "did you mean " + entry.key() + ".name?");
    entry.refuse_missing("name", "add it (" + about_name() + ")");
  }
  const auto given = entry.child("name", about_name());
  require_name(given, names);
  const std::string name = given.text();
  const ViscosityKind* kind = viscosity_laws().find(name);
  refuse_others(entry, name, kind);
  if (kind == nullptr) return;
  ViscosityData& data = fluid.viscosity_model.emplace();
  read_keys(entry, keys_of_model(*kind), data);
  if (const auto wrong = problem_of(kind->make(data.values)))
    entry.child(wrong->parameter, about(*kind->find(wrong->parameter))).refuse_value(wrong->problem, wrong->remedy);
}

void list_model(const FluidData& fluid, const std::string& path, std::vector<CaseValue>& values) {
  if (!fluid.viscosity_model) return;
  list_keys(keys_of_model(viscosity_laws().at(fluid.viscosity_model->name)), *fluid.viscosity_model, path, values);
}

std::vector<KeyHelp> model_help() {
  std::vector<KeyHelp> help = {{"viscosity_model.name", about_name(), required}};
  for (const auto& [law, kind] : viscosity_laws().rows())
    for (const auto& parameter : kind.parameters)
      help.push_back({"viscosity_model." + parameter.name, law + ": " + about(parameter), parameter.required});
  return help;
}

}  // namespace

CaseKey<FluidData> viscosity_model_key() {
  return {"viscosity_model",
          optional,
          "a table { name = \"NAME\", ... }: the law of a viscosity that is no constant, in place of viscosity",
          read_model,
          list_model,
          KeyRole::physics,
          model_help()};
}

void check_viscosity(const CaseEntry& fluid, FluidData& data) {
  if (fluid.has("viscosity")) return;
  if (!data.viscosity_model)
    fluid.refuse_missing("viscosity",
                         fmt::format("add it (dynamic viscosity in {})", std::string(quantity::viscosity().unit)));
  const auto& [name, values] = *data.viscosity_model;
  data.viscosity = viscosity_at(viscosity_laws().at(name).make(values), reference_shear_rate);
  fluid.remark(
      fmt::format("where one viscosity must stand for all shear rates, it is {:.4g} kPa ms, that of {} at {:g} 1/s, "
                  "since viscosity is "
                  "not given",
                  data.viscosity, name, 1e3 * reference_shear_rate));
}

CaseKey<MaterialData> layer_viscosity_key() {
  auto key = leaf(MaterialData::viscosity_key, optional,
                  "of any material: eta in {unit} of a stress eta dE/dt beside the elastic one, default {}",
                  number(at(&MaterialData::viscosity), not_negative, quantity::wall_viscosity()));
  key.list = [list = key.list](const MaterialData& layer, const std::string& path, std::vector<CaseValue>& values) {
    if (layer.viscosity > 0) list(layer, path, values);
  };
  return key;
}

void check_layer_viscosities(const CaseEntry& whole_case, const Case& scene) {
  if (!scene.structure || !scene.static_load) return;
  const CaseEntry layers = whole_case.child("structure").child("layers");
  const auto refuse = [](const CaseEntry& entry) {
    entry.refuse("resists the rate of strain, which a static case has none of",
                 "remove it, or replace [static] by [time]");
  };
  for (const auto& [name, layer] : scene.structure->layers) {
    if (layer.viscosity > 0 && layer.part_of.empty()) refuse(layers.child(name).child(MaterialData::viscosity_key));
  }
  const auto regions = whole_case.child("structure").child("region").children();
  for (const auto& region : regions)
    if (region.has(MaterialData::viscosity_key)) refuse(region.child(MaterialData::viscosity_key));
}

}  // namespace fsi
