#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/name_table.hpp"
#include "case/preconditioner_list.hpp"
#include "mesh_motion/mesh_motion_options.hpp"

namespace fsi {

// The choices of a case file. Names of what lies in higher folders are owned here; the tables that give them a meaning
// are checked against them at compile time, see names_match().

/// partitioned.linear_solver, and the first of monolithic.linear_solver: solvers for any scene and sub-problem. Their
/// factories: linear/choice/general_solvers.hpp.
inline constexpr std::array<std::string_view, 3> general_solver_list{"fast", "direct", "petsc"};

/// Names of linear.preconditioner, as preconditioner_list.hpp has them.
std::vector<std::string> flow_preconditioner_names();

/// The other names of monolithic.linear_solver, for scenes of fluid and wall. Their table:
/// monolithic/linear_solvers.cpp.
inline constexpr std::array<std::string_view, 16> coupled_solver_list{
    "diagonal",   "lower",     "upper", "ssor",      "ilu",        "diagonal_exact", "lower_exact", "upper_exact",
    "ssor_exact", "ilu_exact", "amg",   "amg_gmres", "amg_fgmres", "amli",           "amli_gmres",  "amli_fgmres"};

/// partitioned.scheme. Their table: partitioned/registry.cpp.
inline constexpr std::array<std::string_view, 15> coupling_scheme_list{"aitken",
                                                                       "block-newton",
                                                                       "constant",
                                                                       "explicit",
                                                                       "iqn-ils",
                                                                       "iqn-imvj",
                                                                       "newton-krylov",
                                                                       "robin-neumann",
                                                                       "robin-neumann-inexact",
                                                                       "robin-neumann-iqn",
                                                                       "robin-neumann-imvj",
                                                                       "robin-robin",
                                                                       "robin-robin-corrected",
                                                                       "robin-robin-parallel",
                                                                       "semi-implicit"};

/// Fields of output.fields. Their table: observers/field_output.cpp.
inline constexpr std::array<std::string_view, 10> output_field_list{
    "displacement",     "velocity",         "pressure",     "wall_shear_stress", "cauchy_stress",
    "principal_stress", "von_mises_stress", "fibre_stress", "constants",         "thickness"};
/// The first so many are the default: the solution itself.
inline constexpr std::size_t standard_fields = 3;

/// element: the fields' shape functions.
enum class ElementPair {
  p1,   ///< linear, equal order, stabilised
  p2p1  ///< Taylor-Hood: quadratic vectors, linear scalars
};
/// geometry: the space of a scene.
enum class Geometry { three_dimensional, axisymmetric, plane };
/// time.start: what Windkessels begin with.
enum class StartOfOpenings {
  given,  ///< their initial_pressure
  lumped  ///< that of the periodic state of the laws behind the openings alone (openings/lumped_start.hpp)
};
/// structure.layer_pressure: the wall's pressure where layers meet.
enum class LayerPressure {
  continuous,
  separate  ///< each layer its own: it may jump
};

/// structure.fibre_frame: the frame that fibre directions are given in (docs/theory.md, section 5.6).
enum class FibreFrame {
  cylinder,  ///< of the axis that the case names
  laplace    ///< of potentials between the wall's surfaces, for a wall of any shape
};

/// partitioned.tolerance_of: what the tolerance of the interface applies to (docs/coupling.md).
enum class ToleranceOf {
  displacement,  ///< the gap between fluid and wall, relative to the displacement, as in the paper
  pressure       ///< also the pressure that would close the gap in one step, relative to that on the interface
};

/// The velocity over an opening whose flow is given.
enum class InflowProfile { plug, parabolic, biparabolic, womersley };
const NameTable<InflowProfile>& inflow_profiles();
const NameTable<ToleranceOf>& tolerance_kinds();
/// mesh_motion.method: "harmonic", "stiffened", "nonlinear-elastic"
const NameTable<MeshMotionMethod>& mesh_motion_methods();
const NameTable<StartOfOpenings>& starts_of_openings();
const NameTable<ElementPair>& element_pairs();
const NameTable<Geometry>& geometries();
const NameTable<LayerPressure>& layer_pressures();
const NameTable<FibreFrame>& fibre_frames();

std::vector<std::string> general_solver_names();
std::vector<std::string> linear_solver_names();  ///< of monolithic.linear_solver: general and coupled ones
std::vector<std::string> coupling_scheme_names();
std::vector<std::string> output_field_names();
std::vector<std::string> standard_output_fields();

/// Kinds of stabilisation of equal-order elements (docs/theory.md, sections 3.2 and 4.2).
enum class Stabilisation {
  projected,  ///< of the fluid's pressure: does not fade with the step, since it depends on the scene's wave speed
  paper       ///< PSPG with the step in tau
};

/// stabilisation: "projected", "paper"
const NameTable<Stabilisation>& stabilisation_kinds();

/// economy.constant_operators: "kept" (true), "rebuilt"
const NameTable<bool>& constant_operator_modes();

}  // namespace fsi
