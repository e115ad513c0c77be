#pragma once

#include <variant>

#include "materials/artery.hpp"
#include "materials/compressible_neo_hookean.hpp"
#include "materials/dispersed_artery.hpp"
#include "materials/holzapfel_gasser_ogden.hpp"
#include "materials/linear_elastic.hpp"
#include "materials/mooney_rivlin.hpp"
#include "materials/neo_hookean.hpp"
#include "materials/saint_venant_kirchhoff.hpp"
#include "materials/yeoh.hpp"

namespace fsi {

/// One wall layer's material: the list of all laws. A new one is a file beside these and a row here. Case files,
/// `--help-keys`, the element loops, constants that vary, the membrane and the limit load follow from it; an incomplete
/// law does not compile. A law L states
///   L::name                  its name in case files
///   L::parameters()          its parameters, see ParameterOf
///   L::parameter_sets()      those of which exactly one set is given; only where there are any
///   L::settle()              derives constants from those that are given; only where there are any to derive
///   shear_modulus()          mu of the undeformed isotropic part, kPa
///   own_bulk_modulus()       kappa, kPa, where its own parameters give one; empty: the structure's holds
///   fibre_stiffness()        what fibres add to Young's modulus along the circumference at small strains, kPa
///   inflation_modulus()      m of the pressure m ln(B/A) that a long tube of radii A < B tends to when inflated
///                            without end at its own length, kPa; empty when it stiffens and bears any pressure
/// and, where J - 1 measures its change of volume, being a template of the type of its constants,
///   energy, stress           Psi and S' = 2 dPsi/dC without the volumetric part, kPa, of Strain<T> and FibreData
///   FibreData                Fibres, and then fibre_angle() in radians from the circumference, or NoFibres
///   constants()              pointers to the constants that energy and stress are made of
///   with<Other>              the law with constants of another type: of a pack of points
///   has_own_loops            whether element loops are compiled for it alone: a minute of compiling saves some tenths
///                            of a wall's time. Otherwise it runs through the loops of constants that vary
/// or, where another measure of the volume goes with it (materials/response.hpp),
///   response, energy         of its mu, static
///   on_reference             whether forces balance on the reference configuration
using Material = std::variant<NeoHookean, MooneyRivlin, Artery, SaintVenantKirchhoff, LinearElastic,
                              CompressibleNeoHookean, Yeoh, HolzapfelGasserOgden>;

}  // namespace fsi
