#pragma once

#include "partitioned/interface/coupling_pass.hpp"
#include "partitioned/interface_space.hpp"

namespace fsi {

/// The fluid's added mass over what the wall answers a push of the interface with, both within the stage: the size G
/// of the largest eigenvalue of d -> d~ at rest, by power iteration, an estimate from below. 0: no answer.
/// \param order  of the extrapolated start
template <int n>
double added_mass(const Scene<n>& scene, CouplingPass<n>& problem, const InterfaceSpace& space, int order,
                  const State& state, const StepData& data);

}  // namespace fsi
