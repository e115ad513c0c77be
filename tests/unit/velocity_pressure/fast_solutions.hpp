#pragma once

#include <cmath>
#include <vector>

#include "linear/velocity_pressure/fast_solver.hpp"

namespace fsi::test {

/// Iterates however small the system is.
inline FastOptions iterative() {
  FastOptions options;
  options.direct_below = 0;
  return options;
}

/// |a - b| / |b|
inline double relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double error = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    error += (a[i] - b[i]) * (a[i] - b[i]);
    size += b[i] * b[i];
  }
  return std::sqrt(error / size);
}

}  // namespace fsi::test
