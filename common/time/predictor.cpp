#include "time/predictor.hpp"

#include <algorithm>
#include <cmath>

namespace fsi {

std::array<double, 3> extrapolation_weights(const State& state, int order, double time) {
  return extrapolation_weights(state.times, std::min({order, state.step, 2}), time);
}

std::array<double, 3> extrapolation_weights(const std::array<double, 3>& t, int order, double time) {
  static constexpr std::array<double, 3> equal_steps[] = {{1, 0, 0}, {2, -1, 0}, {3, -3, 1}};
  const double step = time - t[0];
  bool equal = true;
  for (int level = 0; level < order; ++level) equal = equal && std::abs(t[level] - t[level + 1] - step) <= 1e-9 * step;
  if (equal) return equal_steps[order];  // in numbers free of rounding
  std::array<double, 3> weights{};
  for (int i = 0; i <= order; ++i) {  // Lagrange's polynomials
    weights[i] = 1;
    for (int j = 0; j <= order; ++j)
      if (j != i) weights[i] *= (time - t[j]) / (t[i] - t[j]);
  }
  return weights;
}

void predict(State& state, int order, double time) {
  const auto w = extrapolation_weights(state, order, time);
  const auto extrapolate = [&](std::vector<double> Solution::*field) {
    const auto &x0 = state.before[0].*field, &x1 = state.before[1].*field, &x2 = state.before[2].*field;
    auto& x = state.now.*field;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = w[0] * x0[i] + w[1] * x1[i] + w[2] * x2[i];
  };
  extrapolate(&Solution::mesh);
  extrapolate(&Solution::fluid);
  extrapolate(&Solution::wall);
  extrapolate(&Solution::openings);
}

}  // namespace fsi
