#pragma once

#include "case/case.hpp"
#include "linear/interface/linear_solver.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// Linear solvers of the linearised equations of fluid and wall, each solved by itself.
template <int n>
struct MediumSolvers {
  LinearSolverFactory<n> fluid, wall;
  /// The wall's Jacobian decides how both media are solved: linearise the wall before the fluid.
  bool wall_decides = false;
};

/// As partitioned.linear_solver and [linear] ask. With "fast" on one process both media factorise or both iterate, as a
/// system of all their unknowns would: by its size, and in plane scenes by the wall's stiffness. Otherwise each medium
/// has the general solver of that name, independent of the other.
/// \throws InputError for a name that is not one of general_solver_names()
template <int n>
MediumSolvers<n> medium_solvers(const Scene<n>& scene, const PartitionedData& options);

}  // namespace fsi
