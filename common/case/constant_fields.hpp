#pragma once

#include "case/case_keys.hpp"
#include "materials/parameter.hpp"

namespace fsi {

/// The key of a layer's constant, of which the case may also give a file: { file = "NAME.vtu", field = "NAME" }. Its
/// samples are read and checked here; until the scene is built the mean of them stands for the constant.
CaseKey<MaterialData> may_vary(CaseKey<MaterialData> key, const Parameter& parameter);

/// The file of a constant, { file = "NAME.vtu", field = "NAME" }, read and checked.
ConstantField read_constant_field(const CaseEntry& entry, const Parameter& parameter);

/// What stands for a constant that varies until the scene is built.
double stand_in(const ConstantField& field, const Parameter& parameter);

/// What decides of a field, for the case's hash.
std::string text_of(const ConstantField& field);

/// `viscosity` as a parameter of any layer.
const Parameter& layer_viscosity_parameter();

/// The parameter of a layer's material, or the viscosity, of this name; null: none.
const Parameter* constant_of_layer(const MaterialData& layer, const std::string& name);

/// A file that a case names: relative to the case file; given by --set, relative to the working directory if it is there.
std::filesystem::path file_of_entry(const CaseEntry& entry, const std::string& what);

/// Refuses what a reader says of a file, with the key before it. \throws InputError always
[[noreturn]] void refuse_file_of(const CaseEntry& entry, const std::exception& problem);

}  // namespace fsi
