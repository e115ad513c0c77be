#pragma once

namespace fsi {

/// Energies of a time level, uJ = mm^3 kPa, with pressures of the last balance; of this process's elements.
struct LevelEnergy {
  double fluid_kinetic = 0;    ///< rho/2 (J, |u|^2)
  double wall_kinetic = 0;     ///< rho/2 (v, v)
  double wall_isochoric = 0;   ///< (Psi', 1), the materials' energy
  double wall_volumetric = 0;  ///< (p / kappa, p) / 2
  double wall_branches = 0;    ///< in the springs of Maxwell branches
};

}  // namespace fsi
