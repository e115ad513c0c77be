#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/name_table.hpp"
#include "materials/law_list.hpp"
#include "materials/parameter.hpp"

namespace fsi {

/// A material as the case reader sees it.
struct MaterialKind {
  std::vector<Parameter> parameters;
  ParameterSets sets;  ///< exactly one is given; empty: the law has no sets
  bool has_fibres;
  Material (*make)(const ParameterValues& values);  ///< checks nothing

  const Parameter* find(const std::string& name) const;  ///< null: no such parameter
};

/// What is wrong with a material's parameters as a whole, with the remedy.
struct ParameterProblem {
  std::string problem, remedy;
};
/// Empty: nothing. Exactly one of the kind's sets must be given, if it has sets, and make a positive bulk modulus.
std::optional<ParameterProblem> problem_of(const MaterialKind& kind, const ParameterValues& values);
/// All kinds by name, in the order of Material.
const NameTable<MaterialKind>& materials();

/// Names of the kinds with fibres, in the table's order.
std::vector<std::string> materials_with_fibres();

/// Bounds of single values are not checked.
/// \throws InputError for an unknown name, unknown or missing parameters of this material, and problem_of()
Material make_material(const std::string& name, const ParameterValues& values);
/// The values of all its parameters, those that follow from others too.
ParameterValues parameter_values(const Material& material);

// What the rest of the program asks of any material, see law_list.hpp.
double shear_modulus(const Material& material);
/// kappa of a layer, kPa. \param of_structure  kappa where the law has none of its own, kPa
double bulk_modulus(const Material& material, double of_structure);
bool needs_bulk_modulus(const Material& material);  ///< that of the structure: the law has none of its own
double fibre_stiffness(const Material& material);
std::optional<double> inflation_modulus(const Material& material);

/// E / (1 - nu^2) at small strains, kPa: stress per strain around a thin tube of fixed length, E with the fibres, nu of
/// the isotropic part. \param of_structure  kappa where the law has none of its own, kPa
double hoop_modulus(const Material& material, double of_structure);

bool has_fibres(const Material& material);
double fibre_angle(const Material& material);  ///< radians from the circumference; 0 without fibres

}  // namespace fsi
