#pragma once

#include "case/case_keys.hpp"
#include "materials/parameter.hpp"

namespace fsi {

/// The key of a layer's constant, for which the case may also give a file: { file = "NAME.vtu", field = "NAME" }. Its
/// samples are read and checked; until the scene is built stand_in() stands for the constant.
CaseKey<MaterialData> may_vary(CaseKey<MaterialData> key, const Parameter& parameter);

/// Reads and checks the file of a constant, { file = "NAME.vtu", field = "NAME" }; values are converted to the
/// constant's unit, places to mm. \throws InputError
ConstantField read_constant_field(const CaseEntry& entry, const Parameter& parameter);

/// The value that stands for a constant that varies until the scene is built: the mean, 45 degrees for alpha.
double stand_in(const ConstantField& field, const Parameter& parameter);

/// Text of a field for the case's hash.
std::string text_of(const ConstantField& field);

/// `viscosity` as a parameter of any layer.
const Parameter& layer_viscosity_parameter();

/// The parameter of a layer's material, or the viscosity, of this name; null: none.
const Parameter* constant_of_layer(const MaterialData& layer, const std::string& name);

/// Refuses an entry with a file reader's problem and remedy. \throws InputError always
[[noreturn]] void refuse_file_of(const CaseEntry& entry, const std::exception& problem);

}  // namespace fsi
