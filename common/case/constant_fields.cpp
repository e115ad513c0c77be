#include "case/constant_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "base/hash.hpp"
#include "case/key_values.hpp"
#include "materials/material.hpp"
#include "mesh/fields/field_samples.hpp"

namespace fsi {

namespace {

constexpr const char* about_file = "path of a .vtu, .vtp or .csv";

double middle_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What decides of the field: places, values and cells, not the file's name.
std::string hash_of(const FieldSamples& samples) {
  Fnv1a hash;
  const auto add = [&](const auto& numbers) { hash.add(numbers.data(), numbers.size() * sizeof(numbers[0])); };
  add(samples.places);
  add(samples.values);
  add(samples.nodes);
  add(samples.cells);
  add(samples.place_of_cell);
  return hash.hex();
}

}  // namespace

ConstantField read_constant_field(const CaseEntry& entry, const Parameter& parameter) {
  refuse_unknown_keys(entry, {"file", "field", "within"});
  if (!entry.has("file")) entry.refuse_missing("file", fmt::format("add it ({})", about_file));
  if (!entry.has("field"))
    entry.refuse_missing("field", "add it (name of the array, or of the column of a .csv, that holds the constant)");
  const CaseEntry file = entry.child("file", about_file);
  ConstantField field;
  field.key = entry.key();
  field.file = file_of_entry(file, about_file);
  field.field = entry.child("field", "name of an array or column").line();
  if (entry.has("within")) {
    const CaseEntry within = entry.child("within", "distance in mm");
    field.within = within.number(quantity::length());
    if (!(field.within > 0)) within.refuse_value("is not positive", "give a distance > 0");
  }
  FieldSamples samples;
  try {
    samples = read_field_samples(field.file, field.field);
  } catch (const InputError& problem) {
    refuse_file_of(entry, problem);
  }
  for (std::size_t i = 0; i < samples.values.size(); ++i) {
    const double value = samples.values[i];
    const Point& x = samples.places[i];
    const auto at = [&] { return fmt::format("{} at ({:.6g}, {:.6g}, {:.6g}) mm", value, x[0], x[1], x[2]); };
    const std::string& key = entry.key();
    if (!(std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2])))
      throw InputError(field.file.string(), key, fmt::format("point {} has no finite coordinates", i + 1),
                       "write the file anew");
    if (!std::isfinite(value))
      throw InputError(field.file.string(), key, field.field + " is " + at() + ", no finite number",
                       "give a value at each point, or leave the point out");
    if (!parameter.bounds.contains(value))
      throw InputError(field.file.string(), key, field.field + " = " + at() + " " + parameter.bounds.problem(),
                       parameter.bounds.remedy() + " (" + parameter.about + ")");
  }
  entry.warn_of_unit(*parameter.quantity, middle_of(samples.values));
  field.hash = hash_of(samples);
  field.samples = std::make_shared<const FieldSamples>(std::move(samples));
  return field;
}

/// The mean; of angles one that is neither end of their range, since fibres are turned from it.
double stand_in(const ConstantField& field, const Parameter& parameter) {
  if (parameter.name == "alpha") return 45;
  double sum = 0;
  for (const double value : field.samples->values) sum += value;
  return sum / static_cast<double>(field.samples->values.size());
}

std::string text_of(const ConstantField& field) {
  return fmt::format("field \"{}\" of {} points, hash {}, within {}", field.field, field.samples->values.size(),
                     field.hash, field.within > 0 ? fmt::format("{}", field.within) : "chosen");
}

const Parameter& layer_viscosity_parameter() {
  static const Quantity unit{"kPa ms", {}};
  static const Parameter parameter{
      MaterialData::viscosity_key, "eta of the layer", &unit, not_negative, false, 0, false};
  return parameter;
}

const Parameter* constant_of_layer(const MaterialData& layer, const std::string& name) {
  return name == MaterialData::viscosity_key ? &layer_viscosity_parameter() : materials().at(layer.material).find(name);
}

CaseKey<MaterialData> may_vary(CaseKey<MaterialData> key, const Parameter& parameter) {
  key.read = [read = key.read, parameter](const CaseEntry& entry, MaterialData& layer) {
    if (!entry.is_section()) return read(entry, layer);
    ConstantField field = read_constant_field(entry, parameter);
    const double standing = stand_in(field, parameter);
    (parameter.name == MaterialData::viscosity_key ? layer.viscosity : layer.values[parameter.name]) = standing;
    layer.fields[parameter.name] = std::move(field);
  };
  key.list = [list = key.list, name = parameter.name](const MaterialData& layer, const std::string& path,
                                                      std::vector<CaseValue>& values) {
    const auto found = layer.fields.find(name);
    if (found == layer.fields.end()) return list(layer, path, values);
    values.push_back({path, text_of(found->second), KeyRole::physics});
  };
  return key;
}

std::filesystem::path file_of_entry(const CaseEntry& entry, const std::string& what) {
  const std::string name = entry.line();
  if (name.empty()) entry.refuse_value("is empty", "give the " + what);
  std::error_code error;
  if (entry.source().is_overridden(entry.key()) && std::filesystem::exists(name, error)) return name;
  return std::filesystem::path(entry.source().file).parent_path() / name;
}

void refuse_file_of(const CaseEntry& entry, const std::exception& problem) {
  const std::string said = problem.what();  // what is wrong; the remedy
  const auto mark = said.rfind("; ");
  entry.refuse(said.substr(0, mark), mark == std::string::npos ? "give another file" : said.substr(mark + 2));
}

}  // namespace fsi
