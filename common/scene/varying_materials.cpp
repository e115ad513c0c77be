#include "scene/varying_materials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "case/constant_fields.hpp"
#include "fem/elements.hpp"
#include "fields/field_units.hpp"
#include "fields/point_field.hpp"
#include "materials/material.hpp"

namespace fsi {

namespace {

constexpr const char* viscosity_name = MaterialData::viscosity_key;

std::string place_in_mm(const Point& x) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) mm", x[0], x[1], x[2]);
}

/// 1 inside a region, 0 outside, and in between over its transition by 3 s^2 - 2 s^3.
class RegionWeight {
 public:
  explicit RegionWeight(const RegionData& region)
      : outside_(region.shape, region.transition), width_(region.transition) {}
  double operator()(const Point& x) const {
    const double s = std::clamp(0.5 - outside_(x) / width_, 0.0, 1.0);
    return s * s * (3 - 2 * s);
  }

 private:
  RegionDistance outside_;
  double width_;
};

/// A number over a layer's elements.
struct Range {
  double smallest = std::numeric_limits<double>::infinity(), largest = -smallest, integral = 0;

  void add(double value, double weight) {
    smallest = std::min(smallest, value);
    largest = std::max(largest, value);
    integral += weight * value;
  }
};

/// The constants of one layer.
class LayerConstants {
 public:
  /// \param nodes  of the wall here, mm
  LayerConstants(const Case& setup, const std::string& name, const MaterialData& data, const std::vector<Point>& nodes)
      : setup_(setup), name_(name), data_(data), nodes_(nodes), base_(data.values) {
    base_[viscosity_name] = data.viscosity;
    for (const auto& parameter : materials().at(data.material).parameters)
      if (!parameter.of_a_set) base_.emplace(parameter.name, parameter.standard);
    values_ = base_;
    for (const auto& [key, field] : data.fields) {
      fields_.emplace_back(key, PointField(*field.samples, field.within));
      ranges_[key];
    }
    for (const auto& blend : data.blends) {
      std::map<std::string, PointField> fields;
      for (const auto& [key, field] : blend.fields) fields.emplace(key, PointField(*field.samples, field.within));
      blends_.push_back({&blend, RegionWeight(setup.structure->regions[blend.region]), std::move(fields), 0});
      for (const auto& [key, value] : blend.values) ranges_[key];
    }
    completes_ =
        std::any_of(ranges_.begin(), ranges_.end(), [&](const auto& range) { return base_.count(range.first) == 0; });
  }

  /// Whether a parameter varies that decides the law's form.
  bool form_varies(const Material& material) const {
    return std::any_of(ranges_.begin(), ranges_.end(),
                       [&](const auto& range) { return decides_form(material, range.first); });
  }
  const std::map<std::string, Range>& ranges() const { return ranges_; }
  std::map<std::string, Range>& ranges() { return ranges_; }
  double volume = 0;  ///< mm^3
  std::vector<std::int64_t> elements_of_blends() const {
    std::vector<std::int64_t> counts;
    for (const auto& blend : blends_) counts.push_back(blend.elements);
    return counts;
  }

  /// \param mean     by constant, of the element; weight times value is added
  /// \param counted  whether this process counts the element
  LawHere at(const Point& x, double weight, bool counted, std::map<std::string, double>& mean,
             std::set<std::size_t>& in) {
    ParameterValues& values = values_;
    for (const auto& [key, range] : ranges_) {
      const auto known = base_.find(key);
      if (known == base_.end())
        values.erase(key);
      else
        values[key] = known->second;
    }
    for (const auto& [key, field] : fields_) values[key] = from_file(key, data_.fields.at(key), field, x);
    if (completes_) values.merge(parameter_values(material_of(values, x)));
    for (std::size_t b = 0; b < blends_.size(); ++b) {
      const Blend& blend = blends_[b];
      const double w = blend.region(x);
      if (!(w > 0)) continue;
      in.insert(b);
      for (const auto& [key, number] : blend.data->values) {
        const auto field = blend.fields.find(key);
        const double value =
            field == blend.fields.end() ? number : from_file(key, blend.data->fields.at(key), field->second, x);
        values[key] += w * (value - values[key]);
      }
    }
    for (auto& [key, range] : ranges_) {
      mean[key] += weight * values.at(key);
      if (counted) range.add(values.at(key), weight);
    }
    if (counted) volume += weight;
    const double viscosity = values.at(viscosity_name);
    LawHere here;
    const Material material = material_of(values, x);
    here.constants = law_constants(material, setup_.structure->bulk_modulus);
    here.constants.viscosity = viscosity;
    if (has_fibres(material)) here.fibre_angle = fibre_angle(material);
    return here;
  }

  void count(const std::set<std::size_t>& in) {
    for (const std::size_t blend : in) ++blends_[blend].elements;
  }

  /// The material and viscosity at the means.
  std::pair<Material, double> mean() const {
    ParameterValues values = data_.values;
    double viscosity = data_.viscosity;
    for (const auto& [key, range] : ranges_)
      (key == viscosity_name ? viscosity : values[key]) = range.integral / volume;
    return {make_material(data_.material, values), viscosity};
  }

 private:
  struct Blend {
    const ConstantBlend* data;
    RegionWeight region;
    std::map<std::string, PointField> fields;  ///< of the constants that vary in the region
    std::int64_t elements;
  };

  double from_file(const std::string& key, const ConstantField& data, const PointField& field, const Point& x) const {
    if (const auto value = field.at(x)) return *value;
    throw InputError(data.file.string(), data.key.empty() ? "structure.layers." + name_ + "." + key : data.key,
                     fmt::format("has a hole at {}: the nearest value is {:.3g} mm away, {:.3g} mm are allowed",
                                 place_in_mm(x), field.distance_to(x), field.within()),
                     slip_of(key, data, field) + "give values there, too, or a larger within = ... beside file");
  }
  /// What would explain it if the file were in another unit of length; a file in cm has its stresses in dyn/cm^2, mostly.
  std::string slip_of(const std::string& key, const ConstantField& data, const PointField& field) const {
    const auto distance = [&](const Point& x) { return field.distance_to(x); };
    const auto slip = length_slip(nodes_, distance, data.within, field.within());
    if (!slip) return "";
    std::string values;
    const Parameter* parameter = constant_of_layer(data_, key);
    if (parameter != nullptr && std::string(parameter->quantity->unit) == "kPa" && slip->unit == "cm") {
      auto sorted = data.samples->values;
      std::sort(sorted.begin(), sorted.end());
      const double middle = sorted[sorted.size() / 2];
      if (middle >= 1e4)
        values = fmt::format(" and unit = \"dyn/cm^2\", if {:.4g} there is to be {:.4g} kPa", middle, 1e-4 * middle);
    }
    return fmt::format("times {:g} its places would fit: give length_unit = \"{}\" beside file{}; else ", slip->factor,
                       slip->unit, values);
  }
  Material material_of(const ParameterValues& values, const Point& x) const {
    const Material material = materials().at(data_.material).make(values);
    if (!(bulk_modulus(material, setup_.structure->bulk_modulus) > 0))
      throw InputError(setup_.path.string(), "structure.layers." + name_,
                       fmt::format("its constants at {} make a bulk modulus that is not positive", place_in_mm(x)),
                       "give a lame_lambda of more than -2/3 lame_mu everywhere");
    return material;
  }

  const Case& setup_;
  const std::string& name_;
  const MaterialData& data_;
  const std::vector<Point>& nodes_;
  ParameterValues base_;    ///< of the layer, its viscosity among them
  ParameterValues values_;  ///< at the last point
  std::vector<std::pair<std::string, PointField>> fields_;
  std::vector<Blend> blends_;
  std::map<std::string, Range> ranges_;  ///< by constant that varies
  bool completes_;  ///< a region gives constants that outside it follow from the layer's, as those of a second family
};

/// All processes throw what the first that has a problem says of it.
void agree(const Communicator& processes, const std::string& problem) {
  if (!processes.any(!problem.empty())) return;
  const auto lengths = processes.gather(static_cast<std::int64_t>(problem.size()));
  const auto letters = processes.gather(std::vector<int>(problem.begin(), problem.end()));
  for (const std::int64_t length : lengths)
    if (length > 0) {
      const std::string said(letters.begin(), letters.begin() + length);  // FILE: what is wrong with it
      const auto mark = said.find(": ");
      throw InputError(said.substr(0, mark), "", said.substr(mark + 2), "");
    }
}

std::string unit_of(const MaterialData& data, const std::string& key) {
  const Parameter* parameter = constant_of_layer(data, key);
  return parameter == nullptr ? "" : parameter->quantity->unit;
}

/// The file and the regions that say what a constant is.
std::vector<std::string> sources_of(const StructureData& structure, const MaterialData& data, const std::string& key) {
  std::vector<std::string> names;
  if (const auto field = data.fields.find(key); field != data.fields.end())
    names.push_back(field->second.file.filename().string());
  for (const auto& blend : data.blends)
    if (blend.values.count(key) > 0) {
      names.push_back("region " + structure.regions[blend.region].name);
      if (const auto field = blend.fields.find(key); field != blend.fields.end())
        names.push_back(field->second.file.filename().string());
    }
  return names;
}

/// Brings what processes have counted together, and tells the scene of it.
template <int n>
void report(const Case& setup, const std::string& name, const MaterialData& data, LayerConstants& constants,
            const Communicator& processes, Scene<n>& scene) {
  constants.volume = processes.sum(constants.volume);
  for (auto& [key, range] : constants.ranges()) {
    range.integral = processes.sum(range.integral);
    range.smallest = processes.smallest(range.smallest);
    range.largest = processes.largest(range.largest);
    const VaryingConstant said{name,
                               key,
                               unit_of(data, key),
                               range.smallest,
                               range.largest,
                               range.integral / constants.volume,
                               sources_of(*setup.structure, data, key)};
    scene.remarks.push_back(fmt::format("structure.layers.{}.{} varies from {:.4g} to {:.4g} {}, mean {:.4g}", name,
                                        key, said.smallest, said.largest, said.unit, said.mean));
    scene.varying_constants.push_back(said);
  }
  const auto counts = constants.elements_of_blends();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::string& region = setup.structure->regions[data.blends[i].region].name;
    const std::int64_t count = processes.sum(counts[i]);
    if (count > 0)
      scene.remarks.push_back(fmt::format("structure.region.{}: reaches {} elements of {}", region, count, name));
    else if (data.part_of.empty())
      throw InputError(setup.path.string(), "structure.region." + region,
                       fmt::format("no element of {} lies in it", name),
                       "check its place and size in mm, or give layers = [...], those that it is in");
  }
}

/// Names of the constants that differ between parts of the wall or within them.
std::set<std::string> varying_names(const StructureData& structure) {
  std::set<std::string> names;
  for (const auto& region : structure.regions)
    for (const auto& [key, value] : region.values) names.insert(key);
  for (const auto& [name, layer] : structure.layers)
    for (const auto& [key, field] : layer.fields) names.insert(key);
  return names;
}

}  // namespace

template <class Element>
void vary_materials(const Case& setup, WallProblem<Element>& wall, Scene<Element::components>& scene) {
  const StructureData& structure = *setup.structure;
  const auto& part = wall.part();
  for (const auto& name : varying_names(structure)) scene.wall_constants[name].assign(part.cells.size(), 0.0);
  if (scene.wall_constants.empty()) return;
  std::size_t number = 0;
  for (const auto& [name, data] : structure.layers) {
    const std::size_t layer = number++;
    ParameterValues own = data.values;
    own.merge(parameter_values(materials().at(data.material).make(data.values)));
    own[viscosity_name] = data.viscosity;
    for (auto& [key, of_cells] : scene.wall_constants) {
      const double value = own.count(key) > 0 ? own.at(key) : 0;  // 0: the law has no such constant
      for (const int c : wall.cells_of_layer(layer)) of_cells[static_cast<std::size_t>(c)] = value;
    }
    if (!data.varies()) continue;
    LayerConstants constants(setup, name, data, part.nodes);
    std::string problem;
    int points = 0;
    double weights = 0;
    std::map<std::string, double> mean;
    std::set<std::size_t> in;
    try {
      wall.vary(layer, constants.form_varies(wall.layers()[layer].material),
                [&](int cell, const Point& x, double weight) {
                  const bool counted = part.counted.empty() || part.counted[static_cast<std::size_t>(cell)] != 0;
                  const LawHere here = constants.at(x, weight, counted, mean, in);
                  weights += weight;
                  if (++points < Element::points) return here;
                  for (const auto& [key, sum] : mean)
                    scene.wall_constants.at(key)[static_cast<std::size_t>(cell)] = sum / weights;
                  if (counted) constants.count(in);
                  mean.clear();
                  in.clear();
                  points = 0;
                  weights = 0;
                  return here;
                });
    } catch (const InputError& error) {
      problem = error.what();
    }
    agree(part.processes(), problem);
    report(setup, name, data, constants, part.processes(), scene);
    const auto [material, viscosity] = constants.mean();
    wall.set_mean(layer, material, viscosity);
  }
}

#define FSI_INSTANTIATE(Element) \
  template void vary_materials<Element>(const Case&, WallProblem<Element>&, Scene<Element::components>&);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
