#include "time/time_scheme.hpp"

#include <algorithm>
#include <utility>

namespace fsi {

std::vector<double> TimeScheme::acceleration_history(const State& state) const {
  if (is_static()) return {};
  const auto n = static_cast<std::size_t>(components);
  std::vector<double> history(state.wall_velocity.size());
  const double a = acceleration_factor();
  for (std::size_t node = 0; node < history.size() / n; ++node)
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = node * n + k;
      history[i] = -a * state.before[0].wall[node * (n + 1) + k] - state.wall_velocity[i] / (beta * step) -
                   (1 / (2 * beta) - 1) * state.wall_acceleration[i];
    }
  return history;
}

void TimeScheme::predict(State& state) const {
  const int order = std::min({predictor, state.step, 2});
  static constexpr double weights[3][3] = {{1, 0, 0}, {2, -1, 0}, {3, -3, 1}};
  const double* w = weights[order];
  const auto extrapolate = [&](std::vector<double> Solution::*field) {
    const auto &x0 = state.before[0].*field, &x1 = state.before[1].*field, &x2 = state.before[2].*field;
    auto& x = state.now.*field;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = w[0] * x0[i] + w[1] * x1[i] + w[2] * x2[i];
  };
  extrapolate(&Solution::mesh);
  extrapolate(&Solution::flow);
  extrapolate(&Solution::wall);
}

void TimeScheme::accept(State& state, const StepData& data) const {
  const auto n = static_cast<std::size_t>(components);
  if (!is_static()) {
    const double a = acceleration_factor();
    for (std::size_t node = 0; node < state.wall_velocity.size() / n; ++node)
      for (std::size_t k = 0; k < n; ++k) {
        const std::size_t i = node * n + k;
        const double acceleration = a * state.now.wall[node * (n + 1) + k] + data.acceleration_history[i];
        state.wall_velocity[i] += step * (gamma * acceleration + (1 - gamma) * state.wall_acceleration[i]);
        state.wall_acceleration[i] = acceleration;
      }
  }
  std::swap(state.before[2], state.before[1]);
  std::swap(state.before[1], state.before[0]);
  state.before[0] = state.now;
  ++state.step;
  state.time = data.time;
}

}  // namespace fsi
