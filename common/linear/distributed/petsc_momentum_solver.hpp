#pragma once

#include <memory>
#include <vector>

#include "linear/distributed/velocity_pressure_system.hpp"
#include "linear/velocity_pressure/block_preconditioner_choices.hpp"

namespace fsi {

/// Approximate A^-1 of the momentum: symmetric Gauss-Seidel sweeps over n x n blocks within each process (SharedProducts) and,
/// where the wall is stiff, coarse levels of its own momentum between two of them (GAMG on rigid motions of aggregates).
/// Options by the prefixes -fsi_velocity_, with which the sweeps are PETSc's own, and -fsi_wall_.
template <int n>
class PetscMomentumSolver {
 public:
  explicit PetscMomentumSolver(VelocityPressureSystem<n>& system);

  /// Takes the present values of the system.
  void set_up(const BlockPreconditionerChoices& choices);
  void apply(Vec residual, Vec velocities);

  bool has_wall_levels() const { return wall_ != nullptr; }

 private:
  struct WallLevels;

  void make_sweeps(bool wall_levels);
  void make_sweep(PC pc);
  void set_up_wall(bool smoothed);
  static PetscErrorCode apply_wall(PC shell, Vec x, Vec y);
  static PetscErrorCode apply_sweeps(PC shell, Vec x, Vec y);

  VelocityPressureSystem<n>& system_;
  OwnedKsp solver_;           ///< null where sweeps that are not PETSc's are all there is
  bool around_wall_ = false;  ///< the solver is made with coarse levels
  std::vector<PC> sweeps_;    ///< of the solver
  bool by_petsc_;             ///< the sweeps: the case has options for them
  std::shared_ptr<WallLevels> wall_;
};

}  // namespace fsi
