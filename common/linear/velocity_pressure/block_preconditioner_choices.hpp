#pragma once

namespace fsi {

/// What a block preconditioner of velocities and pressures does, decided by the matrix alone, so that a restart decides
/// the same. Defaults by measurement (docs/guide/solvers.md).
struct BlockPreconditionerChoices {
  /// Symmetric Gauss-Seidel sweeps in place of A^-1, or before and after its coarse levels.
  int momentum_sweeps = 1;
  /// Relaxation of these sweeps, 1 but where the wall's inertia exceeds its stiffness: diagonal over lumped diagonal below
  /// `damped_below`. A consistent mass matrix is as much neighbours as diagonal.
  double damping = 0.7, damped_below = 1;
  /// D = diagonal of A + that part of its lumped diagonal, where this is positive.
  static constexpr double lumped_share = 0.2;
  /// The wall's momentum gets coarse levels from this stiffness over mass. Below, their set-up costs more than they
  /// save (fine artery, 0.125 ms).
  double coarse_from = 39;
  /// From this stiffness over mass `petsc` smooths the interpolation of these levels. Below it the set-up costs twice as
  /// much so, and there are more iterations (73: 15 %); above it fewer (198: 30 %, static: 60 %).
  double smoothed_from = 120;
  /// Multiple of diag(B D^-1 G) that S gets in the wall, and from which stiffness over mass; Taylor-Hood elements only
  /// (linear ones need up to twice the iterations with it).
  double added_diagonal = 2;
  double added_from = 39;

  /// Most velocity nodes carry no pressure, as with Taylor-Hood elements.
  static bool has_few_pressures(double pressures, double velocities) { return 2 * pressures < velocities; }

  /// \param stiffness  MomentumDiagonals::stiffness()
  bool has_coarse_levels(double stiffness) const { return stiffness >= coarse_from; }
  bool smooths_aggregates(double stiffness) const { return stiffness >= smoothed_from; }
  double relaxation(double stiffness) const { return stiffness < damped_below ? damping : 1; }
  /// Of the diagonal of S in the wall.
  double wall_diagonal_factor(double stiffness, bool few_pressures) const {
    return few_pressures && stiffness >= added_from ? 1 + added_diagonal : 1;
  }
};

}  // namespace fsi
