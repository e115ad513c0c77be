#include "time/predictor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "time/shifted_midpoint.hpp"

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

// Balances at 2.75, 2.25 and 1.75 ms of steps of 0.5 ms, the next one at 3.25 ms: displacements and velocities on a
// parabola, pressures on a line about which they alternate.
State balanced_state() {
  const auto parabola = [](double t) { return 1 - t + 2 * t * t; };
  State state;
  state.step = 6;
  state.time = 3;
  state.since_jump = state.balances_since_jump = 5;
  state.times = {3, 2.5, 2};
  state.wall_velocity = {7};
  for (int i = 0; i < 3; ++i) {
    const double t = 2.75 - 0.5 * i, pressure = 5 + 3 * t + (i % 2 == 0 ? 100 : -100);
    state.balance_times[i] = t;
    state.balances[i] = {{parabola(t)}, {2 * parabola(t), pressure}, {3 * parabola(t), pressure}};
    const double level = 3 - 0.5 * i;
    state.before[i] = {{level}, {10 + level, 1}, {20 + level, 2}};
  }
  state.now = state.before[0];
  return state;
}

StepData next_balance() {
  StepData data;
  data.rates.time = 3.25;
  data.rates.carry = 0.5;
  return data;
}

TEST(Predictor, OfBalancesIsBlindToPressuresThatAlternate) {
  State state = balanced_state();
  ShiftedMidpoint<1>(0).predict(state, 2, next_balance());
  const double value = 1 - 3.25 + 2 * 3.25 * 3.25, pressure = 5 + 3 * 3.25;
  EXPECT_NEAR(state.now.mesh[0], value, 1e-12);
  EXPECT_NEAR(state.now.fluid[0], 2 * value, 1e-12);
  EXPECT_NEAR(state.now.wall[0], 3 * value, 1e-12);
  EXPECT_NEAR(state.now.fluid[1], pressure, 1e-12);
  EXPECT_NEAR(state.now.wall[1], pressure, 1e-12);
}

TEST(Predictor, OfBalancesGoesThroughAJumpWithTheWallsVelocity) {
  State state = balanced_state();
  state.since_jump = state.balances_since_jump = 0;
  ShiftedMidpoint<1>(0).predict(state, 2, next_balance());
  EXPECT_DOUBLE_EQ(state.now.wall[0], 23 + 0.25 * 7) << "the velocity that it has";
  EXPECT_DOUBLE_EQ(state.now.mesh[0], 3.25) << "the line through the levels";
  EXPECT_DOUBLE_EQ(state.now.fluid[0], 13) << "an acceleration is not known";

  // The step after it: the level at the jump and the balance since.
  state = balanced_state();
  state.since_jump = state.balances_since_jump = 1;
  ShiftedMidpoint<1>(0).predict(state, 2, next_balance());
  const double level = 12.5, balance = state.balances[0].fluid[0];  // at 2.5 and 2.75 ms
  EXPECT_NEAR(state.now.fluid[0], balance + (balance - level) / 0.25 * 0.5, 1e-10);
  EXPECT_EQ(state.now.fluid[1], state.balances[0].fluid[1]) << "one pressure since the jump";
}

}  // namespace

}  // namespace fsi::test
