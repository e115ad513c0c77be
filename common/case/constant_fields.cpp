#include "case/constant_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/error.hpp"
#include "base/hash.hpp"
#include "case/key_values.hpp"
#include "case/table_units.hpp"
#include "fields/field_units.hpp"
#include "materials/material.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

constexpr const char* about_file = "path of a .vtu, .vtp or .csv";

double middle_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Hash of places, values and cells, not of the file's name.
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

/// Factor from the unit that `word` names to the unit `right` of a constant; empty: no unit of such a constant.
std::optional<double> value_unit(const std::string& right, const std::string& word) {
  static const std::map<std::string, std::vector<std::pair<const char*, double>>> units{
      {"kPa ms",
       {{"kPa ms", 1}, {"Pa s", 1}, {"mPa s", 1e-3}, {"kPa s", 1e3}, {"poise", 0.1}, {"P", 0.1}, {"cP", 1e-3}}},
      {"degrees", {{"degrees", 1}, {"deg", 1}, {"radians", 57.29577951308232}, {"rad", 57.29577951308232}}}};
  if (right == "kPa") {
    if (word == "dyne/cm2" || word == "dyne/cm^2") return 1e-4;
    if (word == "N/mm2" || word == "N/mm^2") return 1e3;
    if (word == "GPa") return 1e6;
    try {
      const auto unit = column_unit("[" + word + "]", ColumnKind::pressure);
      return unit ? std::optional<double>(unit->factor) : std::nullopt;
    } catch (const std::invalid_argument&) {
      return std::nullopt;
    }
  }
  if (word == right) return 1;
  const auto known = units.find(right);
  if (known == units.end()) return std::nullopt;
  for (const auto& [name, factor] : known->second)
    if (word == name) return factor;
  return std::nullopt;
}

std::string known_value_units(const std::string& right) {
  if (right == "kPa") return known_units(ColumnKind::pressure);
  if (right == "degrees") return "degrees or radians";
  if (right == "kPa ms") return "kPa ms, Pa s, mPa s or poise";
  return right.empty() ? "none: it is a pure number" : right;
}

/// A unit that the case gives by a key, or the file itself; the case's must not contradict the file's.
std::string unit_word(const CaseEntry& entry, const char* key, const std::string& of_file) {
  if (!entry.has(key)) return of_file;
  const CaseEntry given = entry.child(key, "a unit");
  if (!of_file.empty() && given.line() != of_file)
    given.refuse_value("is not what the header of the file says, " + of_file, "remove it, or correct the header");
  return given.line();
}

/// Brings places and values to mm and the unit of the constant. \return the unit that places were in
std::string apply_units(const CaseEntry& entry, const Parameter& parameter, const UnitsOfFile& own, bool& unit_given,
                        FieldSamples& samples) {
  std::string lengths = unit_word(entry, "length_unit", own.places);
  if (own.places.empty() && !lengths.empty()) {
    const auto factor = length_unit(lengths);
    if (!factor) entry.child("length_unit").refuse_value("is no known unit of length", "give " + known_length_units());
    for (auto* points : {&samples.places, &samples.nodes})
      for (Point& x : *points) x = *factor * x;
  }
  const std::string unit = unit_word(entry, "unit", own.values), right = parameter.quantity->unit;
  unit_given = !unit.empty();
  if (!unit_given) return lengths;
  const auto factor = value_unit(right, unit);
  if (!factor)
    (entry.has("unit") ? entry.child("unit") : entry)
        .refuse("\"" + unit + "\" is no known unit of " + parameter.name, "give " + known_value_units(right));
  for (double& value : samples.values) value *= *factor;
  return lengths;
}

/// Warns of values that look like another unit's. 1e5 may be Pa or dyn/cm^2: the unit of lengths tells SI from cgs.
void warn_of_values(const CaseEntry& entry, const Quantity& quantity, double middle, const std::string& lengths) {
  constexpr double most_dynes = 1e8;  // 10 MPa, of calcified walls
  const auto slip = unit_slip(quantity, middle);
  const bool stress = std::string(quantity.unit) == "kPa";
  const bool by_size = stress && !slip && middle > 1e7 && middle <= most_dynes;
  if (!slip && !by_size) return;
  const std::string pascal = "Pa", dyne = "dyn/cm^2";
  if (!by_size && !(stress && (slip->unit == pascal || slip->unit == dyne))) {
    entry.warn_of_unit(quantity, middle);
    return;
  }
  const double in_pascal = 1e-3 * middle, in_dyne = 1e-4 * middle;
  if (by_size || lengths == "cm")
    return entry.warn(fmt::format("{:g} looks like a value in {}", middle, dyne),
                      fmt::format("did you mean {:.4g} kPa? Give unit = \"{}\" beside file", in_dyne, dyne));
  if (lengths == "m")
    return entry.warn(fmt::format("{:g} looks like a value in {}", middle, pascal),
                      fmt::format("did you mean {:.4g} kPa? Give unit = \"{}\" beside file", in_pascal, pascal));
  entry.warn(fmt::format("{:g} looks like a value in {} or {}", middle, dyne, pascal),
             fmt::format("give unit = \"{}\" beside file for {:.4g} kPa, unit = \"{}\" for {:.4g} kPa", dyne, in_dyne,
                         pascal, in_pascal));
}

}  // namespace

ConstantField read_constant_field(const CaseEntry& entry, const Parameter& parameter) {
  refuse_unknown_keys(entry, {"file", "field", "within", "unit", "length_unit"});
  if (!entry.has("file")) entry.refuse_missing("file", fmt::format("add it ({})", about_file));
  if (!entry.has("field"))
    entry.refuse_missing("field", "add it (name of the array, or of the column of a .csv, that holds the constant)");
  const CaseEntry file = entry.child("file", about_file);
  ConstantField field;
  field.key = entry.key();
  field.file = file.path(about_file);
  field.field = entry.child("field", "name of an array or column").line();
  if (entry.has("within")) {
    const CaseEntry within = entry.child("within", "distance in mm");
    field.within = within.number(quantity::length());
    if (!(field.within > 0)) within.refuse_value("is not positive", "give a distance > 0");
  }
  FieldSamples samples;
  UnitsOfFile units;
  try {
    samples = read_field_samples(field.file, field.field, units);
  } catch (const InputError& problem) {
    refuse_file_of(entry, problem);
  }
  bool unit_given = false;
  const std::string lengths = apply_units(entry, parameter, units, unit_given, samples);
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
  if (!unit_given) warn_of_values(entry, *parameter.quantity, middle_of(samples.values), lengths);
  field.hash = hash_of(samples);
  field.samples = std::make_shared<const FieldSamples>(std::move(samples));
  return field;
}

/// The mean; for alpha, an angle in degrees, 45: not an end of its range, since fibres are turned from it.
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
  static const Parameter parameter{
      MaterialData::viscosity_key, "eta of the layer", &quantity::wall_viscosity(), not_negative, false, 0, false};
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

void refuse_file_of(const CaseEntry& entry, const std::exception& problem) {
  const std::string said = problem.what();  // what is wrong; the remedy
  const auto mark = said.rfind("; ");
  entry.refuse(said.substr(0, mark), mark == std::string::npos ? "give another file" : said.substr(mark + 2));
}

}  // namespace fsi
