#include <gtest/gtest.h>

#include <cmath>

#include "time/time_scheme.hpp"

namespace fsi::test {

namespace {

/// A wall of one node: entries (d, p) with one component.
State one_node(double d, double v, double a) {
  State state;
  state.now.wall = {d, 0.0};
  state.before = {state.now, state.now, state.now};
  state.wall_velocity = {v};
  state.wall_acceleration = {a};
  return state;
}

/// Marches d'' = -d from d = 1, v = 0 by the scheme; returns the error against cos t at t = 2.
double oscillator_error(TimeScheme scheme, int steps) {
  scheme.components = 1;
  scheme.step = 2.0 / steps;
  State state = one_node(1, 0, -1);
  for (int n = 1; n <= steps; ++n) {
    StepData data;
    data.time = n * scheme.step;
    data.acceleration_history = scheme.acceleration_history(state);
    // a^n = factor d + history = -d
    state.now.wall[0] = -data.acceleration_history[0] / (scheme.acceleration_factor() + 1);
    scheme.accept(state, data);
  }
  return std::abs(state.now.wall[0] - std::cos(2.0));
}

double observed_order(const TimeScheme& scheme) {
  return std::log2(oscillator_error(scheme, 200) / oscillator_error(scheme, 400));
}

TEST(TimeScheme, NewmarkOnAnOscillatorIsOfFirstOrderForBetaGammaOne) {
  EXPECT_NEAR(observed_order({0, 1, 1, 1, 1}), 1, 0.05);
}

TEST(TimeScheme, NewmarkOnAnOscillatorIsOfSecondOrderForTheTrapezoidalRule) {
  EXPECT_NEAR(observed_order({0, 0.25, 0.5, 1, 1}), 2, 0.05);
}

TEST(TimeScheme, TrapezoidalRuleKeepsTheEnergy) {
  TimeScheme scheme{0.3, 0.25, 0.5, 1, 1};
  State state = one_node(1, 0, -1);
  for (int n = 1; n <= 100; ++n) {
    StepData data;
    data.acceleration_history = scheme.acceleration_history(state);
    state.now.wall[0] = -data.acceleration_history[0] / (scheme.acceleration_factor() + 1);
    scheme.accept(state, data);
    EXPECT_NEAR(state.now.wall[0] * state.now.wall[0] + state.wall_velocity[0] * state.wall_velocity[0], 1, 1e-13);
  }
}

// The formulas of design, section 2, item 5, with numbers put in by hand: dt = 0.5, beta = 0.4, gamma = 0.6, d = 2
// after 1, v = 3, a = 4: a^n = 1/(0.4 0.25) - 3/(0.4 0.5) - (1.25 - 1) 4 = 10 - 15 - 1 = -6; v^n = 3 + 0.5 (0.6 (-6) +
// 0.4 4) = 2.
TEST(TimeScheme, NewmarkFormulasByHand) {
  const TimeScheme scheme{0.5, 0.4, 0.6, 1, 1};
  State state = one_node(1, 3, 4);
  EXPECT_DOUBLE_EQ(scheme.acceleration_factor(), 10);
  StepData data;
  data.time = 0.5;
  data.acceleration_history = scheme.acceleration_history(state);
  EXPECT_NEAR(data.acceleration_history[0], -26, 1e-13);
  state.now.wall = {2, 7};
  scheme.accept(state, data);
  EXPECT_NEAR(state.wall_acceleration[0], -6, 1e-13);
  EXPECT_NEAR(state.wall_velocity[0], 2, 1e-13);
  EXPECT_EQ(state.before[0].wall, (std::vector<double>{2, 7}));
  EXPECT_EQ(state.before[1].wall, (std::vector<double>{1, 0}));
  EXPECT_EQ(state.step, 1);
  EXPECT_EQ(state.time, 0.5);
}

TEST(TimeScheme, PressuresDoNotEnterTheAcceleration) {
  const TimeScheme scheme{0.5, 1, 1, 1, 3};
  State state;
  state.now.wall = {1, 2, 3, 1e6, 4, 5, 6, 1e6};  // two nodes of (d, p)
  state.before = {state.now, state.now, state.now};
  state.wall_velocity.assign(6, 0.0);
  state.wall_acceleration.assign(6, 0.0);
  const auto history = scheme.acceleration_history(state);
  for (int i = 0; i < 6; ++i) EXPECT_DOUBLE_EQ(history[i], -4.0 * (i + 1));
}

TEST(TimeScheme, StaticsHasNoAcceleration) {
  const TimeScheme scheme{};
  EXPECT_TRUE(scheme.is_static());
  EXPECT_EQ(scheme.acceleration_factor(), 0);
  State state = one_node(1, 0, 0);
  EXPECT_TRUE(scheme.acceleration_history(state).empty());
  state.now.wall = {5, 5};
  StepData data;
  data.time = 0.1;
  scheme.accept(state, data);
  EXPECT_EQ(state.before[0].wall[0], 5);
  EXPECT_EQ(state.wall_velocity[0], 0);
}

/// Values of a polynomial of time in all three fields, levels at t = step dt and before.
State polynomial_state(int degree, int step) {
  const auto at = [&](int n) {
    double value = 0;
    for (int k = 0; k <= degree; ++k) value += (k + 1) * std::pow(0.5 * n, k);
    return Solution{{value, -value}, {2 * value}, {3 * value}};
  };
  State state;
  state.step = step;
  for (int level = 0; level < 3; ++level) state.before[level] = at(step - level);
  state.now = at(step + 1);  // only to be compared with
  return state;
}

TEST(TimeScheme, PredictorsAreExactForPolynomialsOfTheirOrderAndNotBeyond) {
  for (int predictor = 0; predictor <= 2; ++predictor)
    for (int degree = 0; degree <= 3; ++degree) {
      const TimeScheme scheme{0.5, 1, 1, predictor, 1};
      State state = polynomial_state(degree, 5);
      const Solution exact = state.now;
      state.now = {{9, 9}, {9}, {9}};
      scheme.predict(state);
      const double error = std::abs(state.now.mesh[0] - exact.mesh[0]) + std::abs(state.now.mesh[1] - exact.mesh[1]) +
                           std::abs(state.now.flow[0] - exact.flow[0]) + std::abs(state.now.wall[0] - exact.wall[0]);
      EXPECT_EQ(error < 1e-12, degree <= predictor) << predictor << " " << degree << " " << error;
    }
}

TEST(TimeScheme, PredictorsWaitForEnoughFinishedLevels) {
  const TimeScheme scheme{0.5, 1, 1, 2, 1};
  for (int step = 0; step <= 3; ++step) {
    State state = polynomial_state(2, step);
    const auto level = [&](int n) { return state.before[n].wall[0]; };
    const double expected[] = {level(0), 2 * level(0) - level(1), 3 * level(0) - 3 * level(1) + level(2)};
    scheme.predict(state);
    EXPECT_DOUBLE_EQ(state.now.wall[0], expected[std::min(step, 2)]) << step;
  }
}

}  // namespace

}  // namespace fsi::test
