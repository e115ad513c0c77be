#pragma once

#include "partitioned/interface/coupling_pass.hpp"
#include "partitioned/interface_space.hpp"

namespace fsi {

/// The fluid's added mass over the wall's inertia and stiffness within the stage: the magnitude G of the largest
/// eigenvalue of d -> d~ at rest, by power iteration, an estimate from below. 0: a pass failed, or nothing moved.
/// Collective.
/// \param problem  solved on copies of state and data that end with this call: call its start() before the next pass
/// \param order    of the extrapolated start
template <int n>
double added_mass(const Scene<n>& scene, CouplingPass<n>& problem, const InterfaceSpace& space, int order,
                  const State& state, const StepData& data);

}  // namespace fsi
