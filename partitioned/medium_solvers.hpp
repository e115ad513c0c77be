#pragma once

#include "case/case.hpp"
#include "linear/interface/linear_solver.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// Of the linearised equations of fluid and wall where each is solved by itself.
template <int n>
struct MediumSolvers {
  LinearSolverFactory<n> fluid, wall;
  /// The fluid's follows what the wall's Jacobian says, which is to be made before the fluid's.
  bool wall_decides = false;
};

/// As partitioned.linear_solver and [linear] ask. Both media factorise, or both iterate, as a system of all their
/// unknowns would: by its size, and in plane scenes by the wall's stiffness.
template <int n>
MediumSolvers<n> medium_solvers(const Scene<n>& scene, const PartitionedData& options);

}  // namespace fsi
