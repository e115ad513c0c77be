#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "base/name_table.hpp"
#include "materials/artery.hpp"
#include "materials/compressible_law.hpp"
#include "materials/dispersed_artery.hpp"
#include "materials/mooney_rivlin.hpp"
#include "materials/neo_hookean.hpp"
#include "materials/parameter.hpp"

namespace fsi {

/// One wall layer's material: the table of all there are. A new one is a file beside these and an entry here; case
/// files, `--help-keys`, the membrane and the limit load know it from then on. A law L states
///   L::name                  its name in case files
///   L::parameters()          its parameters, see ParameterOf
///   L::parameter_sets()      those of which exactly one set is given; only where there are any
///   shear_modulus()          mu of the undeformed isotropic part, kPa
///   own_bulk_modulus()       kappa, kPa, where its own parameters give one; empty: the structure's holds
///   fibre_stiffness()        what fibres add to Young's modulus along the circumference at small strains, kPa
///   inflation_modulus()      m of the pressure m ln(B/A) that a long tube of radii A < B tends to when inflated
///                            without end at its own length, kPa; empty when it stiffens and bears any pressure
/// and to the element loops, itself or by element_law():
///   energy, stress           Psi and S' = 2 dPsi/dC without the volumetric part, kPa, of Strain<T> and FibreData
///   FibreData                Fibres, and then fibre_angle() in radians from the circumference, or NoFibres
/// or, where J - 1 does not measure its change of volume, what CompressibleLaw makes of it.
using Material =
    std::variant<NeoHookean, MooneyRivlin, Artery, SaintVenantKirchhoff, LinearElastic, CompressibleNeoHookean>;

/// A layer's law as the element loops see it.
using ElementLaw = std::variant<NeoHookean, MooneyRivlin, Artery, DispersedArtery, CompressibleLaw>;
ElementLaw element_law(const Material& material);

/// A material as the case reader sees it.
struct MaterialKind {
  std::vector<Parameter> parameters;
  ParameterSets sets;
  bool has_fibres;
  Material (*make)(const ParameterValues& values);

  const Parameter* find(const std::string& name) const;
};

/// What is wrong with a material's parameters as a whole, with the remedy.
struct ParameterProblem {
  std::string problem, remedy;
};
/// Whether exactly one of the kind's sets is given, and makes a solid that resists compression.
std::optional<ParameterProblem> problem_of(const MaterialKind& kind, const ParameterValues& values);
/// All kinds by name, in the order of Material.
const NameTable<MaterialKind>& materials();

/// Names of the kinds with fibres, in the table's order.
std::vector<std::string> materials_with_fibres();

/// \throws InputError for an unknown name, a value that is no parameter of this material and a missing one
Material make_material(const std::string& name, const ParameterValues& values);

// What the rest of the program asks of any material, see above.
double shear_modulus(const Material& material);
/// kappa of a layer, kPa. \param of_structure  where its law has none of its own
double bulk_modulus(const Material& material, double of_structure);
bool needs_bulk_modulus(const Material& material);  ///< that of the structure
double fibre_stiffness(const Material& material);
std::optional<double> inflation_modulus(const Material& material);

/// E / (1 - nu^2) at small strains, kPa: stress per strain around a thin tube that is held along its axis, E counting
/// the fibres, nu that of the isotropic part. \param of_structure  kappa where the law has none of its own, kPa
double hoop_modulus(const Material& material, double of_structure);

bool has_fibres(const Material& material);
double fibre_angle(const Material& material);  ///< radians from the circumference; 0 without fibres

}  // namespace fsi
