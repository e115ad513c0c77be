#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algebra/block_matrix.hpp"
#include "fem/element_packs.hpp"
#include "fem/nodal_layout.hpp"
#include "materials/material.hpp"
#include "materials/maxwell_branch.hpp"
#include "materials/varying_law.hpp"
#include "wall/fibre_directions.hpp"

namespace fsi {

/// What the wall's residual depends on. The acceleration is acceleration_factor d + acceleration_history, as a Newmark
/// scheme makes it; the history is null in statics.
struct WallInput {
  const double* wall = nullptr;                  ///< (d_s, p_s), mixed layout, mm and kPa
  const double* acceleration_history = nullptr;  ///< vector layout, mm/ms^2
  double acceleration_factor = 0;                ///< 1/ms^2

  const double* prestress = nullptr;  ///< displacement from the unloaded shape to the mesh, vector layout, mm
  bool finds_unloaded_shape = false;  ///< d is that displacement itself, and the equations hold on the mesh

  double strain_lag = 0;  ///< ms, of the strain's rate (wall/kelvin_voigt.hpp)

  // What supports ask besides (wall/supports.hpp).
  const double* velocity_reference = nullptr;  ///< r of v = velocity_rate (d - r), mixed layout, mm; null: not known
  double velocity_rate = 0;                    ///< 1/ms; 0 in statics
  /// In the order of the supports' loads, kPa, of forces per volume kPa/mm; null: none.
  const double* support_loads = nullptr;
  const double* branch_reference = nullptr;  ///< r of what Maxwell branches keep (BranchPlaces); null: none, or statics
};

/// The constants at each quadrature point of a layer, [thread][pack][point].
template <class Element>
using ConstantsField = std::vector<std::vector<std::array<PointConstants, Element::points>>>;

/// One layer of the wall: its elements and its material, with fibre directions where the material has fibres.
template <class Element>
struct WallLayer {
  ElementPacks<Element> packs;
  Material material;
  FibreField<Element> fibres;  ///< empty for materials without
  double viscosity = 0;        ///< eta, kPa ms, of wall/kelvin_voigt.hpp
  /// Where constants vary, or the law has no loops of its own: theirs, with the fibres; `material` and `viscosity` are at
  /// the means of what varies.
  ConstantsField<Element> constants{};
  VaryingLaw law{};                       ///< of such a layer
  std::vector<MaxwellBranch> branches{};  ///< wall/maxwell_form.hpp

  bool varies() const { return !constants.empty(); }
  ElementLaw element_law() const { return varies() ? ElementLaw(law) : fsi::element_law(material); }
};

/// Where the strains that Maxwell branches keep stand in an array (Solution::branches): cell by cell of the layers with
/// branches, point by point, branch by branch, six numbers each (xx, yy, zz and the three shears, in the order of Sym3).
/// Layers with fewer branches than others leave room. Empty for a wall without branches.
struct BranchPlaces {
  std::vector<int> cells;          ///< of the part, ascending
  std::vector<int> place_of_cell;  ///< per cell of the part its place among these; -1: none
  std::size_t branches = 0;        ///< most of a layer, of all processes alike
  std::size_t entries = 0;         ///< numbers per cell; 0: no layer has branches
  /// Per cell with a place: its number in the whole wall, and whether sums count it here.
  std::vector<std::int64_t> whole_cell{};
  std::vector<char> counted{};

  std::size_t size() const { return cells.size() * entries; }
};

/// Blocks with rows (momentum, volume) and columns (d, p).
template <int n>
using WallMatrix = BlockMatrix<MixedLayout<n>::entries, MixedLayout<n>::entries>;

/// What the layers of a wall have in common.
struct WallConstants {
  double density;         ///< mg/mm^3
  double bulk_modulus;    ///< kPa, of layers whose material has none of its own
  double stabilisation;   ///< alpha
  double wave_speed = 0;  ///< c_w of the stabilisation, mm/ms; 0: statics, no fluid, or not asked for
};

/// One balance of a step of the wall: where its equations hold, with what weight, and the levels between which the step
/// leads. Wall arrays hold (d, p) in the mixed layout, in mm and kPa, velocities are in the vector layout.
struct WallStep {
  WallInput balance;
  const double* reference = nullptr;  ///< r: the balance's velocity is v = rate (d - r)
  double rate = 1;                    ///< 1/ms; 1 in statics, where "velocity" is d - r
  double duration = 1;                ///< ms, of the balance in the step: its weight times the step; 1 in statics
  double weight = 1;                  ///< those of a step add up to one
  /// The balance before, whose volume equation is subtracted; null for one that has had its turn in the step before.
  const double* wall_before = nullptr;
  const double* start = nullptr;  ///< levels
  const double* end = nullptr;
  const double* velocity_start = nullptr;  ///< mm/ms; null in statics
  const double* velocity_end = nullptr;
  /// What Maxwell branches keep, of the balance and of both levels; null: there are none.
  const double *branches = nullptr, *branches_start = nullptr, *branches_end = nullptr;
};

/// Energy of the wall, uJ = mm^3 kPa.
struct WallEnergy {
  double kinetic = 0;     ///< rho/2 (v, v)
  double isochoric = 0;   ///< (Psi', 1), the materials' energy
  double volumetric = 0;  ///< (p / kappa, p) / 2
  double branches = 0;    ///< in the springs of Maxwell branches

  WallEnergy& operator+=(const WallEnergy& b) {
    kinetic += b.kinetic;
    isochoric += b.isochoric;
    volumetric += b.volumetric;
    branches += b.branches;
    return *this;
  }
};

/// What the discrete equations of one balance, momentum tested with its velocity v for its duration W, the difference of
/// the volume equations to the balance before with -p, do besides changing the energy (docs/energy.md); all in uJ. With
/// levels 0 and 1, values without index those of the balance, index b those of the balance before, weight omega and
/// S(d, p, q) = (tau J F^-T grad p, F^-T grad q), summed over the balances of a step
///   W (rho a, v) = kinetic_1 - kinetic_0 + inertia,
///   W (F S' - p J F^-T, grad v) = stress + volumetric_1 - volumetric_0 + stabilisation,
/// the volumetric energy being that of balances.
struct WallWork {
  double inertia = 0;  ///< rho (W a, v) - omega rho/2 (|v_1|^2 - |v_0|^2, 1): the scheme in time
  /// W (F S', grad v) - (p, W G : grad v - (g - g_b)) + (p - p_b, p - p_b) / (2 kappa): what the stress does, but for the
  /// change of the volumetric energy; of branches what theirs does beyond the change of their energy
  double stress = 0;
  double stabilisation = 0;  ///< S(d, p, p) - S(d_b, p_b, p)
  double viscous = 0;        ///< W (eta dE/dt, dE/dt) and that in the dashpots of branches: dissipation in the layers

  WallWork& operator+=(const WallWork& b) {
    inertia += b.inertia;
    stress += b.stress;
    stabilisation += b.stabilisation;
    viscous += b.viscous;
    return *this;
  }
};

}  // namespace fsi
