#include "case/layer_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/names.hpp"
#include "case/constant_fields.hpp"
#include "case/key_values.hpp"
#include "case/maxwell_keys.hpp"
#include "case/parameter_keys.hpp"
#include "case/viscosity_keys.hpp"
#include "materials/material.hpp"

namespace fsi {

namespace {

using presence::optional, presence::required;

/// The keys of a layer of this material: its name and its parameters.
std::vector<CaseKey<MaterialData>> layer_keys(const MaterialKind& kind) {
  std::vector<CaseKey<MaterialData>> keys = {
      leaf("material", required, "its model: " + one_of(materials().names()), any_text(at(&MaterialData::material)))};
  for (const auto& p : kind.parameters) keys.push_back(may_vary(parameter_key(p, at(&MaterialData::values)), p));
  keys.push_back(may_vary(layer_viscosity_key(), layer_viscosity_parameter()));
  keys.push_back(layer_branches_key());
  return keys;
}

}  // namespace

void read_layer(const CaseEntry& entry, MaterialData& layer, const std::vector<std::string>& others) {
  const auto names = materials().names();
  const std::string about_material = "its model: " + one_of(names);
  const auto children = entry.children();
  if (!entry.has("material")) {
    // A misspelt `material` explains better why there is none.
    for (const auto& child : children)
      if (edit_distance(child.key(), entry.key() + ".material") <= 2)
        child.refuse("unknown key", "did you mean " + entry.key() + ".material?");
    entry.refuse_missing("material", "add it (" + about_material + ")");
  }
  const auto name = entry.child("material", about_material);
  require_name(name, names);
  const MaterialKind& kind = materials().at(name.text());

  // A parameter of another material is no misspelling: the message says what this one takes.
  for (const auto& child : children) {
    const auto key = child.key().substr(entry.key().size() + 1);
    if (key == "material" || key == MaterialData::viscosity_key || key == "maxwell" || kind.find(key) != nullptr ||
        contains(others, key))
      continue;
    for (const auto& [other, other_kind] : materials().rows()) {
      if (other_kind.find(key) == nullptr) continue;
      std::vector<std::string> own;
      for (const auto& parameter : kind.parameters) own.push_back(parameter.name);
      child.refuse("is no parameter of " + name.text() + " but of " + other,
                   "remove it (" + name.text() + " takes " + one_of(own) + ")");
    }
  }
  const auto keys = layer_keys(kind);
  std::vector<std::string> known = others;
  for (const auto& key : keys) known.push_back(key.name);
  refuse_unknown_keys(entry, known);
  for (const auto& key : keys)
    if (entry.has(key.name))
      key.read(entry.child(key.name, key.about), layer);
    else if (key.required)
      entry.refuse_missing(key.name, "add it (" + key.about + ")");
  if (const auto wrong = problem_of(kind, layer.values)) entry.refuse(wrong->problem, wrong->remedy);
}

namespace {

void read_layers(const CaseEntry& entry, StructureData& structure) {
  const auto layers = entry.children();
  if (layers.empty())
    entry.refuse("has no layer", "add a section [structure.layers.NAME] per volume group of the wall");
  for (const auto& layer : layers) {
    const auto name = layer.key().substr(entry.key().size() + 1);
    if (name == "fluid" || name.empty() || name.find('/') != std::string::npos)
      layer.refuse("\"" + name + "\" cannot be a layer", "use the name of a volume group of the wall");
    read_layer(layer, structure.layers[name]);
  }
}

void list_layers(const StructureData& structure, const std::string& path, std::vector<CaseValue>& values) {
  for (const auto& [name, layer] : structure.layers)
    if (layer.part_of.empty()) list_keys(layer_keys(materials().at(layer.material)), layer, path + "." + name, values);
}

std::vector<KeyHelp> layers_help() {
  std::vector<KeyHelp> help = {{"layers.NAME.material", one_of(materials().names()), required}};
  for (const auto& [material, kind] : materials().rows())
    for (const auto& parameter : kind.parameters)
      help.push_back({"layers.NAME." + parameter.name, material + ": " + about(parameter), parameter.required});
  help.push_back({"layers.NAME.viscosity", layer_viscosity_key().about, optional});
  help.push_back({"layers.NAME.maxwell", layer_branches_key().about, optional});
  help.push_back(
      {"layers.NAME.CONSTANT.file",
       "of any constant that varies, { file = \"FILE\", field = \"NAME\" } in place of a number: a .vtu, .vtp, or .csv "
       "with columns x, y, z",
       optional});
  help.push_back({"layers.NAME.CONSTANT.field", "name of the array or column", optional});
  help.push_back({"layers.NAME.CONSTANT.within",
                  "how far the wall may be from the file's points in mm, default three times their distance",
                  optional});
  help.push_back({"layers.NAME.CONSTANT.unit", "of the file's values, default that of the constant", optional});
  help.push_back({"layers.NAME.CONSTANT.length_unit", "of the file's coordinates, default mm", optional});
  return help;
}

}  // namespace

CaseKey<StructureData> layers_key() {
  return {"layers",     required,    "a section [structure.layers.NAME] per volume group of the wall",
          read_layers,  list_layers, KeyRole::physics,
          layers_help()};
}

void check_structure(const CaseEntry& entry, const StructureData& structure) {
  const bool needed = std::any_of(structure.layers.begin(), structure.layers.end(), [](const auto& layer) {
    return needs_bulk_modulus(make_material(layer.second.material, layer.second.values));
  });
  const bool given = entry.has("bulk_modulus");
  if (needed && !given) entry.refuse_missing("bulk_modulus", "add it (bulk modulus in kPa)");
  if (given && !needed)
    entry.child("bulk_modulus")
        .refuse("belongs to no layer: each has a bulk modulus of its own by its elastic constants", "remove it");
}

}  // namespace fsi
