#pragma once

#include "time/state.hpp"

namespace fsi {

/// Weights of the finished levels, the latest first, in the polynomial of degree `order` (0 to 2) through them, taken
/// at `time` (ms). The order is cut while fewer levels are finished. For equal steps (1), (2, -1), (3, -3, 1).
std::array<double, 3> extrapolation_weights(const State& state, int order, double time);
/// The same for values at `times`, the latest first; `order` is not cut.
std::array<double, 3> extrapolation_weights(const std::array<double, 3>& times, int order, double time);

/// Writes the extrapolation of the finished levels to `time` to state.now, the first guess of a step. Maxwell branches
/// are not extrapolated: they are no unknowns.
void predict(State& state, int order, double time);

}  // namespace fsi
