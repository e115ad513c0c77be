#include "case/region_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "base/hash.hpp"
#include "base/name_table.hpp"
#include "base/names.hpp"
#include "case/constant_fields.hpp"
#include "case/key_values.hpp"
#include "case/layer_keys.hpp"
#include "fields/field_units.hpp"
#include "fields/point_table.hpp"
#include "materials/material.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

using presence::optional;
using Kind = RegionShape::Kind;

/// A region as it stands in the file.
struct RegionInput {
  RegionData region;
  std::string file;
  std::string length_unit{};
  int order = 0;
};

const NameTable<Kind>& shapes() {
  static const NameTable<Kind> table{
      "shape", {{"box", Kind::box}, {"sphere", Kind::sphere}, {"line", Kind::line}, {"surface", Kind::surface}}};
  return table;
}

void read_layer_names(const CaseEntry& entry, RegionInput& input) {
  for (const CaseEntry& name : entry.elements()) input.region.layers.push_back(name.line());
  if (input.region.layers.empty()) entry.refuse_name("is empty", "give names of layers, or leave it out for all");
}

std::string text_of(const std::vector<std::string>& names) {
  return fmt::format("[{}]", fmt::join(names, ", "));
}

/// A member of the region's shape.
template <class Value>
Place<RegionInput, Value> of_shape(Value RegionShape::*member) {
  return {[=](RegionInput& input) -> Value& { return input.region.shape.*member; }};
}

/// Keys of all shapes and those that every region has. keys_of_shape() tells them apart.
std::vector<CaseKey<RegionInput>> region_keys() {
  using Key = RegionInput;
  const auto length = [](auto place, const Bounds& bounds) { return number(place, bounds, quantity::length()); };
  return {
      leaf<Key>("layers", optional, "names of the layers that it is in, default all",
                {read_layer_names, [](const Key& input) { return text_of(input.region.layers); }}),
      leaf("shape", presence::required,
           "its shape: box, sphere, line (what is near a line of points) or surface (what is near one)",
           name_from(of_shape(&RegionShape::kind), shapes())),
      leaf("low", optional, "of a box: its lowest corner in {unit}", point(of_shape(&RegionShape::low), false)),
      leaf("high", optional, "of a box: its highest corner in {unit}", point(of_shape(&RegionShape::high), false)),
      leaf("centre", optional, "of a sphere: its centre in {unit}", point(of_shape(&RegionShape::centre), false)),
      leaf("radius", optional, "of a sphere: its radius in {unit}", length(of_shape(&RegionShape::radius), positive)),
      leaf<Key>(
          "file", optional,
          "of a line: a .csv with columns x, y, z in mm; of a surface: a .vtp or .stl, as painted in another program",
          {[](const CaseEntry& entry, Key& input) { input.file = entry.line(); },
           [](const Key& input) { return input.region.hash; }}),
      leaf<Key>("length_unit", optional,
                "of a line or surface: the unit of its file's coordinates, default mm (cm, m, um, in)",
                {[](const CaseEntry& entry, Key& input) { input.length_unit = entry.line(); },
                 [](const Key&) { return std::string("mm"); }}),
      leaf("within", optional, "of a line or surface: how near is near, in {unit}",
           length(of_shape(&RegionShape::within), positive)),
      leaf("from", optional, "of a line: where the stretch begins that counts, {unit} from its first point, default {}",
           length(of_shape(&RegionShape::from), not_negative)),
      leaf("to", optional, "of a line: where that stretch ends, in {unit}, default 0: its last point",
           length(of_shape(&RegionShape::to), not_negative)),
      leaf("transition", optional,
           "width in {unit} in which constants go over to the region's; default {}: whole elements, by their centres",
           length(at(&RegionInput::region, &RegionData::transition), not_negative)),
      leaf(
          "order", optional,
          "which of two regions has an element of both: the one of the higher order; of [[structure.region]] the place "
          "in the list",
          whole(at(&RegionInput::order), 0, 1'000'000)),
  };
}

/// Which of the keys above a shape has.
std::vector<std::string> keys_of_shape(Kind kind) {
  switch (kind) {
    case Kind::box:
      return {"low", "high"};
    case Kind::sphere:
      return {"centre", "radius"};
    case Kind::line:
      return {"file", "within", "from", "to", "length_unit"};
    case Kind::surface:
      break;
  }
  return {"file", "within", "length_unit"};
}

void check_shape(const CaseEntry& entry, const RegionShape& shape) {
  const std::string name = shapes().name_of(shape.kind);
  const auto own = keys_of_shape(shape.kind);
  for (const char* key : {"low", "high", "centre", "radius", "file", "within", "from", "to", "length_unit"}) {
    const bool belongs = contains(own, key), may_lack = contains({"from", "to", "length_unit"}, key);
    if (belongs && !may_lack && !entry.has(key))
      entry.refuse_missing(key, fmt::format("add it (a {} takes {})", name, fmt::join(own, ", ")));
    if (!belongs && entry.has(key))
      entry.child(key).refuse("is no key of a " + name,
                              fmt::format("remove it (a {} takes {})", name, fmt::join(own, ", ")));
  }
  if (shape.kind == Kind::box)
    for (int d = 0; d < 3; ++d)
      if (!(shape.low[d] < shape.high[d]))
        entry.child("high").refuse_value("is not above low", "give a corner that is higher in x, y and z");
  if (shape.to > 0 && shape.to <= shape.from) entry.child("to").refuse_value("is not behind from", "give a larger one");
}

void read_file(const CaseEntry& region, RegionInput& input) {
  const CaseEntry entry = region.child("file");
  const std::optional<double> length = input.length_unit.empty() ? 1.0 : length_unit(input.length_unit);
  if (!length) region.child("length_unit").refuse_value("is no known unit of length", "give " + known_length_units());
  RegionShape& shape = input.region.shape;
  Fnv1a hash;
  const auto add = [&](const auto& numbers) { hash.add(numbers.data(), numbers.size() * sizeof(numbers[0])); };
  const auto path = entry.path("path of a file");
  try {
    if (shape.kind == Kind::line) {
      constexpr const char* kinds = "give a .csv with columns x, y, z in mm";
      if (path.extension() != ".csv") throw InputError(path.string(), "", "is no .csv", kinds);
      std::string said;
      auto line = polyline_of(text_of_file(path, kinds), path.string(), said);
      if (!said.empty() && !input.length_unit.empty() && said != input.length_unit)
        throw InputError(path.string(), "", "says itself that it is in " + said, "remove length_unit");
      if (said.empty())
        for (Point& x : line) x = *length * x;
      shape.line = std::make_shared<const std::vector<Point>>(std::move(line));
      add(*shape.line);
    } else {
      auto surface = read_painted_surface(path);
      for (Point& x : surface.nodes) x = *length * x;
      shape.surface = std::make_shared<const PaintedSurface>(std::move(surface));
      add(shape.surface->nodes);
      add(shape.surface->triangles);
    }
  } catch (const InputError& problem) {
    refuse_file_of(entry, problem);
  }
  input.region.hash = hash.hex();
}

/// The layer with the region's constants in place of its own.
MaterialData replaced_layer(const MaterialData& layer, const RegionData& region) {
  MaterialData part = layer;
  for (const auto& [name, value] : region.values) {
    (name == MaterialData::viscosity_key ? part.viscosity : part.values[name]) = value;
    part.fields.erase(name);
    if (const auto field = region.fields.find(name); field != region.fields.end()) part.fields.insert(*field);
    for (auto& blend : part.blends) {
      blend.values.erase(name);
      blend.fields.erase(name);
    }
  }
  part.blends.erase(
      std::remove_if(part.blends.begin(), part.blends.end(), [](const auto& b) { return b.values.empty(); }),
      part.blends.end());
  return part;
}

/// Constants of the region that are none of a layer's material are refused.
void read_constants(const CaseEntry& entry, const std::vector<std::string>& known, const StructureData& structure,
                    RegionData& region) {
  for (const CaseEntry& child : entry.children()) {
    const std::string key = child.key().substr(entry.key().size() + 1);
    if (contains(known, key)) continue;
    for (const auto& layer : region.layers) {
      const MaterialData& data = structure.layers.at(layer);
      const Parameter* parameter = constant_of_layer(data, key);
      if (parameter == nullptr) {
        std::vector<std::string> names;
        for (const auto& p : materials().at(data.material).parameters) names.push_back(p.name);
        names.push_back(MaterialData::viscosity_key);
        for (const auto& name : keys_of_shape(region.shape.kind)) names.push_back(name);
        for (const char* name : {"layers", "material", "transition", "order"}) names.emplace_back(name);
        child.refuse(
            fmt::format("is no key of a region and no constant of {}, the material of {}", data.material, layer),
            name_remedy(key, names));
      }
      if (child.is_section()) {
        ConstantField field = read_constant_field(child, *parameter);
        region.values[key] = stand_in(field, *parameter);
        region.fields[key] = std::move(field);
        continue;
      }
      const double value = child.number(*parameter->quantity);
      if (!parameter->bounds.contains(value))
        child.refuse_value(parameter->bounds.problem(), parameter->bounds.remedy());
      region.values[key] = value;
    }
  }
  if (region.values.empty())
    entry.refuse("has no constants", "give those that differ there, as young = 1000, or a material");
}

void check_whole(const CaseEntry& entry, const std::string& layer, const MaterialData& part) {
  if (const auto wrong = problem_of(materials().at(part.material), part.values))
    entry.refuse(fmt::format("in {}: {}", layer, wrong->problem), wrong->remedy);
}

/// Puts a region into its layers and into the parts that earlier regions have cut out of them.
void apply(const CaseEntry& entry, const RegionData& region, const MaterialData* material, StructureData& structure) {
  const std::size_t number = structure.regions.size();
  for (const auto& name : region.layers) {
    const MaterialData& layer = structure.layers.at(name);
    if (region.transition > 0) {
      check_whole(entry, name, replaced_layer(layer, region));
      for (auto& [other, data] : structure.layers)
        if (other == name || data.part_of == name) {
          if (data.material == layer.material) data.blends.push_back({number, region.values, region.fields});
        }
      continue;
    }
    MaterialData part = material != nullptr ? *material : replaced_layer(layer, region);
    if (material == nullptr) check_whole(entry, name, part);
    part.part_of = name;
    part.region = number;
    structure.layers[name + "/" + region.name] = std::move(part);
  }
}

void read_region(const CaseEntry& entry, StructureData& structure, RegionInput& input) {
  RegionData& region = input.region;
  region.name = entry.key().substr(entry.key().rfind('.') + 1);
  const auto keys = region_keys();
  std::vector<std::string> known;
  for (const auto& key : keys) known.push_back(key.name);
  if (!entry.has("shape")) entry.refuse_missing("shape", "add it (" + one_of(shapes().names()) + ")");
  for (const auto& key : keys)
    if (entry.has(key.name)) key.read(entry.child(key.name, key.about), input);
  std::vector<std::string> all;
  for (const auto& [name, layer] : structure.layers)
    if (layer.part_of.empty()) all.push_back(name);
  for (const auto& name : region.layers)
    if (!contains(all, name)) entry.child("layers").refuse("\"" + name + "\" is no layer", name_remedy(name, all));
  if (region.layers.empty()) region.layers = all;
  check_shape(entry, region.shape);
  if (entry.has("file")) read_file(entry, input);
  if (!entry.has("material")) {
    read_constants(entry, known, structure, region);
    return apply(entry, region, nullptr, structure);
  }
  if (region.transition > 0)
    entry.child("transition")
        .refuse("stands beside a material of its own", "remove one of them: constants go over, laws do not");
  MaterialData material;
  read_layer(entry, material, known);
  region.material = material.material;
  region.values = material.values;
  if (material.viscosity > 0) region.values[MaterialData::viscosity_key] = material.viscosity;
  region.fields = material.fields;
  if (!material.maxwell.empty())
    entry.child("maxwell").refuse("stands in a region",
                                  "make its branches those of a layer: give it a volume of the mesh");
  apply(entry, region, &material, structure);
}

}  // namespace

CaseKey<StructureData> regions_key() {
  CaseKey<StructureData> key{"region", optional, "", nullptr, nullptr, KeyRole::physics};
  key.about =
      "[[structure.region]] with a name: a part of the wall, by its shape, with constants of its own, as young = 1000, "
      "or "
      "with a material";
  for (const auto& child : region_keys())
    key.below.push_back({"region.NAME." + child.name, child.about, child.required});
  key.below.push_back(
      {"region.NAME.CONSTANT",
       "a constant of the layers that is another there: a number, or { file = \"FILE\", field = \"NAME\" } "
       "as in a layer",
       optional});
  key.read = [](const CaseEntry& entry, StructureData& structure) {
    std::vector<std::pair<int, CaseEntry>> ordered;
    for (const auto& child : entry.children()) {
      if (!child.is_section()) child.refuse("is no section", "begin each region with a line [[structure.region]]");
      const std::string name = child.key().substr(entry.key().size() + 1);
      if (name.empty() || name.find_first_of("./") != std::string::npos)
        child.refuse("\"" + name + "\" cannot be a region", "give a name without . and /");
      ordered.emplace_back(child.has("order") ? child.child("order").whole_number(0, 1'000'000) : 0, child);
    }
    std::stable_sort(ordered.begin(), ordered.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [order, child] : ordered) {
      RegionInput input;
      read_region(child, structure, input);
      structure.regions.push_back(std::move(input.region));
    }
  };
  key.list = [](const StructureData& structure, const std::string& path, std::vector<CaseValue>& values) {
    for (std::size_t i = 0; i < structure.regions.size(); ++i) {
      const RegionData& region = structure.regions[i];
      const std::string here = path + "." + region.name + ".";
      const RegionInput input{region, "", "", static_cast<int>(i)};
      const auto own = keys_of_shape(region.shape.kind);
      for (const auto& child : region_keys())
        if ((contains(own, child.name) && child.name != "length_unit") || child.name == "layers" ||
            child.name == "shape" || child.name == "transition" || child.name == "order")
          child.list(input, here + child.name, values);
      if (!region.material.empty()) values.push_back({here + "material", region.material, KeyRole::physics});
      for (const auto& [name, value] : region.values)
        values.push_back({here + name,
                          region.fields.count(name) > 0 ? text_of(region.fields.at(name)) : fmt::format("{}", value),
                          KeyRole::physics});
    }
  };
  return key;
}

}  // namespace fsi
