#include <gtest/gtest.h>

#include "time/euler_newmark.hpp"
#include "time/loads.hpp"

namespace fsi::test {

namespace {

/// Sum of step times load over all steps.
template <class Pressure>
double impulse(Case& setup, double step, Pressure pressure) {
  setup.time->step = step;
  const Loads loads(setup);
  const EulerNewmark<1> scheme;
  State state;
  double sum = 0;
  for (int n = 0; n < loads.steps(); ++n) {
    const StepData data = loads.next(state, scheme);
    EXPECT_NEAR(data.rates.step, data.time - state.time, 1e-12) << "the last step is as long as it is";
    sum += (data.time - state.time) * pressure(data);
    state.time = data.time;
    ++state.step;
  }
  EXPECT_EQ(state.time, setup.time->end) << "the end is hit exactly";
  return sum;
}

// The paper's pulse: 1.332 kPa until 0.125 ms.
TEST(Loads, ImpulseDoesNotDependOnTheTimeStep) {
  Case setup;
  setup.time = TimeData{};
  setup.time->end = 1.2;
  setup.fluid = FluidData{};
  setup.inlet = PressureTable{{{0, 1.332}, {0.125, 1.332}, {0.125, 0}}};
  setup.load = PressureTable{{{0, 0}, {0.3, 2}, {0.7, 2}, {0.9, 0}}};
  for (double step : {0.0125, 0.05, 0.1, 0.3, 0.6, 1.2}) {
    EXPECT_NEAR(impulse(setup, step, [](const StepData& data) { return data.opening_pressures.at(0); }), 1.332 * 0.125,
                1e-15)
        << step;
    EXPECT_NEAR(impulse(setup, step, [](const StepData& data) { return data.wall_pressure; }), 0.3 + 0.8 + 0.2, 1e-14)
        << step;
  }
}

TEST(Loads, OfAStepIsTheMeanOverItNotTheValueAtItsEnd) {
  Case setup;
  setup.time = TimeData{};
  setup.time->step = 0.5;
  setup.time->end = 2;
  setup.fluid = FluidData{};
  setup.inlet = PressureTable{{{0, 0}, {2, 4}}};
  const Loads loads(setup);
  EXPECT_EQ(loads.steps(), 4);
  State state;
  state.step = 1;
  state.time = 0.5;
  const auto data = loads.next(state, EulerNewmark<1>());
  EXPECT_DOUBLE_EQ(data.time, 1.0);
  ASSERT_EQ(data.opening_pressures.size(), 2u);
  EXPECT_DOUBLE_EQ(data.opening_pressures[0], 1.5);
  EXPECT_EQ(data.opening_pressures[1], 0) << "the outlet is free of traction";
  EXPECT_EQ(data.wall_pressure, 0);
}

TEST(Loads, StaticLoadRisesInEqualStepsToTheLastValue) {
  Case setup;
  setup.static_load = StaticData{4};
  setup.load = PressureTable{{{0, 0}, {1, 0.8}}};
  const Loads loads(setup);
  EXPECT_EQ(loads.steps(), 4);
  State state;
  for (state.step = 0; state.step < 4; ++state.step) {
    const auto data = loads.next(state, QuasiStatic());
    EXPECT_DOUBLE_EQ(data.time, 0.25 * (state.step + 1));
    EXPECT_DOUBLE_EQ(data.wall_pressure, 0.2 * (state.step + 1));
    EXPECT_TRUE(data.rates.acceleration_history.empty());
  }
}

}  // namespace

}  // namespace fsi::test
