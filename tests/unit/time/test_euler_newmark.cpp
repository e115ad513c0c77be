#include "time/euler_newmark.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

/// A step of d'' = -d: a = factor d + history = -d.
void oscillate(const EulerNewmark<1>& scheme, State& state, double step) {
  StepData data;
  data.time = state.time + step;
  data.rates = scheme.rates(state, step);
  state.now.wall[0] = -data.rates.acceleration_history[0] / (data.rates.acceleration_factor + 1);
  scheme.accept(state, data);
}

/// Marches from d = 1, v = 0; returns the error against cos t at t = 2. Every third step is twice as long as the others
/// where `uneven`.
double oscillator_error(const NewmarkParameters& newmark, int steps, bool uneven) {
  const EulerNewmark<1> scheme(newmark);
  State state = one_node(1, 0, -1);
  const double unit = 2.0 / (uneven ? steps / 3 * 4 : steps);
  for (int n = 1; n <= steps; ++n) oscillate(scheme, state, uneven && n % 3 == 0 ? 2 * unit : unit);
  EXPECT_NEAR(state.time, 2, 1e-12);
  return std::abs(state.now.wall[0] - std::cos(2.0));
}

double observed_order(const NewmarkParameters& newmark, bool uneven) {
  return std::log2(oscillator_error(newmark, 300, uneven) / oscillator_error(newmark, 600, uneven));
}

TEST(EulerNewmark, OnAnOscillatorIsOfFirstOrderForBetaGammaOneWithEqualAndUnequalSteps) {
  EXPECT_NEAR(observed_order({1, 1}, false), 1, 0.05);
  EXPECT_NEAR(observed_order({1, 1}, true), 1, 0.05);
}

TEST(EulerNewmark, OnAnOscillatorIsOfSecondOrderForTheTrapezoidalRuleWithEqualAndUnequalSteps) {
  EXPECT_NEAR(observed_order({0.25, 0.5}, false), 2, 0.05);
  EXPECT_NEAR(observed_order({0.25, 0.5}, true), 2, 0.05);
}

TEST(EulerNewmark, TrapezoidalRuleKeepsTheEnergyWhateverTheSteps) {
  const EulerNewmark<1> scheme({0.25, 0.5});
  State state = one_node(1, 0, -1);
  for (int n = 1; n <= 100; ++n) {
    oscillate(scheme, state, n % 2 ? 0.3 : 0.1);
    EXPECT_NEAR(state.now.wall[0] * state.now.wall[0] + state.wall_velocity[0] * state.wall_velocity[0], 1, 1e-13);
  }
}

// Newmark's formulas (docs/theory.md, section 8.2) with numbers put in by hand:
// dt = 0.5, beta = 0.4, gamma = 0.6, d = 2 after 1, v = 3, a = 4:
// a^n = 1/(0.4 0.25) - 3/(0.4 0.5) - (1.25 - 1) 4 = 10 - 15 - 1 = -6; v^n = 3 + 0.5 (0.6 (-6) + 0.4 4) = 2.
TEST(EulerNewmark, FormulasByHand) {
  const EulerNewmark<1> scheme({0.4, 0.6});
  State state = one_node(1, 3, 4);
  StepData data;
  data.time = 0.5;
  data.rates = scheme.rates(state, 0.5);
  EXPECT_DOUBLE_EQ(data.rates.acceleration_factor, 10);
  EXPECT_NEAR(data.rates.acceleration_history[0], -26, 1e-13);
  state.now.wall = {2, 7};
  scheme.accept(state, data);
  EXPECT_NEAR(state.wall_acceleration[0], -6, 1e-13);
  EXPECT_NEAR(state.wall_velocity[0], 2, 1e-13);
  EXPECT_EQ(state.before[0].wall, (std::vector<double>{2, 7}));
  EXPECT_EQ(state.before[1].wall, (std::vector<double>{1, 0}));
  EXPECT_EQ(state.step, 1);
  EXPECT_EQ(state.time, 0.5);
  EXPECT_EQ(state.times[0], 0.5);
}

TEST(EulerNewmark, PressuresDoNotEnterTheAcceleration) {
  State state;
  state.now.wall = {1, 2, 3, 1e6, 4, 5, 6, 1e6};  // two nodes of (d, p)
  state.before = {state.now, state.now, state.now};
  state.wall_velocity.assign(6, 0.0);
  state.wall_acceleration.assign(6, 0.0);
  const auto rates = EulerNewmark<3>().rates(state, 0.5);
  for (int i = 0; i < 6; ++i) EXPECT_DOUBLE_EQ(rates.acceleration_history[i], -4.0 * (i + 1));
}

TEST(EulerNewmark, MeshFlowAndInterfaceAreBackwardEuler) {
  State state = one_node(1, 3, 4);
  state.before[0].mesh = {5};
  state.before[0].fluid = {6, 7};
  const StepRates rates = EulerNewmark<1>().rates(state, 0.5);
  EXPECT_FALSE(rates.is_static());
  EXPECT_EQ(rates.fluid_factor, 2);
  EXPECT_EQ(rates.interface.rate(), 2);
  EXPECT_EQ(rates.mesh_reference, state.before[0].mesh);
  EXPECT_EQ(rates.fluid_reference, state.before[0].fluid);
  EXPECT_EQ(rates.wall_reference, state.before[0].wall);
}

TEST(InterfaceKinematics, VelocityAndDisplacementAreInverseToEachOther) {
  const InterfaceKinematics interface { 0.25 };
  EXPECT_EQ(interface.velocity(3, 1), 8);
  EXPECT_EQ(interface.displacement(8, 1), 3);
  EXPECT_EQ(interface.velocity_change(0.5), 2);
  EXPECT_EQ(interface.rate(), 4);
}

TEST(QuasiStatic, HasNoRates) {
  const QuasiStatic statics;
  EXPECT_TRUE(statics.is_static());
  State state = one_node(1, 0, 0);
  StepData data;
  data.rates = statics.rates(state, 0);
  EXPECT_TRUE(data.rates.is_static());
  EXPECT_EQ(data.rates.acceleration_factor, 0);
  EXPECT_TRUE(data.rates.acceleration_history.empty());
  state.now.wall = {5, 5};
  data.time = 0.1;
  statics.accept(state, data);
  EXPECT_EQ(state.before[0].wall[0], 5);
  EXPECT_EQ(state.wall_velocity[0], 0);
}

}  // namespace

}  // namespace fsi::test
