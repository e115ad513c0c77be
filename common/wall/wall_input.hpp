#pragma once

#include <vector>

#include "algebra/block_matrix.hpp"
#include "fem/element_packs.hpp"
#include "fem/nodal_layout.hpp"
#include "materials/material.hpp"
#include "wall/fibre_directions.hpp"

namespace fsi {

/// What the wall's residual depends on. The acceleration is acceleration_factor d + acceleration_history, as a Newmark
/// scheme makes it; the history is null in statics.
struct WallInput {
  const double* wall = nullptr;                  ///< (d_s, p_s), mixed layout, mm and kPa
  const double* acceleration_history = nullptr;  ///< vector layout, mm/ms^2
  double acceleration_factor = 0;                ///< 1/ms^2
};

/// One layer of the wall: its elements and its material, with fibre directions where the material has fibres.
template <class Element>
struct WallLayer {
  ElementPacks<Element> packs;
  Material material;
  FibreField<Element> fibres;  ///< empty for materials without
};

/// Blocks with rows (momentum, volume) and columns (d, p).
template <int n>
using WallMatrix = BlockMatrix<MixedLayout<n>::entries, MixedLayout<n>::entries>;

/// What the layers of a wall have in common.
struct WallConstants {
  double density;         ///< mg/mm^3
  double bulk_modulus;    ///< kPa
  double stabilisation;   ///< alpha
  double wave_speed = 0;  ///< c_w of the stabilisation, mm/ms; 0: statics, no fluid, or not asked for
};

/// Two ends of a step of the wall. Wall arrays hold (d, p) in the mixed layout, in mm and kPa, the others are in
/// the vector layout; those are null in statics.
struct WallStep {
  const double* wall = nullptr;
  const double* wall_old = nullptr;
  const double* velocity = nullptr;      ///< mm/ms
  const double* acceleration = nullptr;  ///< mm/ms^2
  const double* acceleration_old = nullptr;
  double step = 0, beta = 1, gamma = 1;  ///< of Newmark's scheme; step in ms
};

/// Energy of the wall at the end of a step, and what the step's discrete equations, momentum tested with the step's
/// displacement d_1 - d_0, volume at both ends with -p_1, do besides changing it (docs/energy.md); all in uJ = mm^3
/// kPa. With da = a_1 - a_0, dd = d_1 - d_0 and S(d, p, q) = (tau J F^-T grad p, F^-T grad q):
///   (rho a_1, dd) = kinetic_1 - kinetic_0 + inertia,
///   (F S' - p J F^-T, grad dd) = isochoric_1 - isochoric_0 + volumetric_1 - volumetric_0 + stress + stabilisation,
/// the latter up to the sixth order of grad dd where the stress is smooth: its mean along the step is by Radau's rule.
struct WallEnergy {
  double kinetic = 0;     ///< rho/2 (v, v), v Newmark's velocity, at the end
  double isochoric = 0;   ///< (Psi, 1), the materials' energy, at the end
  double volumetric = 0;  ///< (p / kappa, p) / 2 at the end
  double inertia = 0;     ///< rho (da, (1 - gamma) dd + (beta - gamma/2) dt^2 (gamma a_1 + (1 - gamma) a_0))
  /// (F_1 S'_1 - mean of F S' along the step, grad dd) - (p_1, cof F_1 : grad dd - (J_1 - J_0)) + (dp / kappa, dp) / 2:
  /// stress and pressure at the step's end, not along it
  double stress = 0;
  double stabilisation = 0;  ///< S(d_1, p_1, p_1) - S(d_0, p_0, p_1)

  WallEnergy& operator+=(const WallEnergy& b) {
    kinetic += b.kinetic;
    isochoric += b.isochoric;
    volumetric += b.volumetric;
    inertia += b.inertia;
    stress += b.stress;
    stabilisation += b.stabilisation;
    return *this;
  }
};

}  // namespace fsi
