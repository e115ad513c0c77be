#include "time/predictor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace fsi::test {

namespace {

/// Values of a polynomial of time in all three fields, at the times of the levels; `now` is the next one, only to be
/// compared with.
State polynomial_state(int degree, int step, const std::array<double, 4>& times) {
  const auto at = [&](double t) {
    double value = 0;
    for (int k = 0; k <= degree; ++k) value += (k + 1) * std::pow(t, k);
    return Solution{{value, -value}, {2 * value}, {3 * value}};
  };
  State state;
  state.step = step;
  for (int level = 0; level < 3; ++level) {
    state.times[level] = times[level + 1];
    state.before[level] = at(times[level + 1]);
  }
  state.now = at(times[0]);
  return state;
}

constexpr std::array<double, 4> equal_steps{3.0, 2.5, 2.0, 1.5}, unequal_steps{3.0, 2.75, 2.0, 1.9};

TEST(Predictor, IsExactForPolynomialsOfItsOrderAndNotBeyondWhateverTheSteps) {
  for (const auto& times : {equal_steps, unequal_steps})
    for (int order = 0; order <= 2; ++order)
      for (int degree = 0; degree <= 3; ++degree) {
        State state = polynomial_state(degree, 5, times);
        const Solution exact = state.now;
        state.now = {{9, 9}, {9}, {9}};
        predict(state, order, times[0]);
        const double error = std::abs(state.now.mesh[0] - exact.mesh[0]) + std::abs(state.now.mesh[1] - exact.mesh[1]) +
                             std::abs(state.now.fluid[0] - exact.fluid[0]) +
                             std::abs(state.now.wall[0] - exact.wall[0]);
        EXPECT_EQ(error < 1e-11, degree <= order) << order << " " << degree << " " << error;
      }
}

TEST(Predictor, WaitsForEnoughFinishedLevels) {
  for (int step = 0; step <= 3; ++step) {
    State state = polynomial_state(2, step, equal_steps);
    const auto level = [&](int n) { return state.before[n].wall[0]; };
    const double expected[] = {level(0), 2 * level(0) - level(1), 3 * level(0) - 3 * level(1) + level(2)};
    predict(state, 2, equal_steps[0]);
    EXPECT_DOUBLE_EQ(state.now.wall[0], expected[std::min(step, 2)]) << step;
  }
}

TEST(Predictor, HasWeightsWithoutRoundingForEqualSteps) {
  State state;
  state.step = 3;
  state.times = {0.3, 0.2, 0.1};  // no two differences alike in binary
  EXPECT_EQ(extrapolation_weights(state, 2, 0.4), (std::array<double, 3>{3, -3, 1}));
}

}  // namespace

}  // namespace fsi::test
