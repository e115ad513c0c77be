#pragma once

#include <vector>

#include "time/state.hpp"

namespace fsi {

/// Backward Euler for the fluid and Newmark's method for the wall (design, section 2, item 5):
///   a^n = (d^n - d^(n-1)) / (beta dt^2) - v^(n-1) / (beta dt) - (1/(2 beta) - 1) a^(n-1),
///   v^n = v^(n-1) + dt (gamma a^n + (1 - gamma) a^(n-1)).
struct TimeScheme {
  double step = 0;  ///< dt, ms; 0 in statics
  double beta = 1, gamma = 1;
  int predictor = 1;  ///< order of the extrapolated start
  int components = 3;

  bool is_static() const { return step == 0; }
  /// Derivative of a^n with respect to d^n.
  double acceleration_factor() const { return is_static() ? 0.0 : 1.0 / (beta * step * step); }
  /// a^n - acceleration_factor() d^n, n numbers per wall node; empty in statics.
  std::vector<double> acceleration_history(const State& state) const;
  /// Writes the extrapolation of the finished levels to state.now. The order is cut while there are too few of them.
  void predict(State& state) const;
  /// Takes state.now as the result of the step: updates the wall's velocity and acceleration and shifts the levels.
  void accept(State& state, const StepData& data) const;
};

}  // namespace fsi
