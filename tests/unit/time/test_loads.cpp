#include <gtest/gtest.h>

#include "time/loads.hpp"

namespace fsi::test {

namespace {

/// Sum of step times load over all steps.
double impulse(Case& setup, double step, double StepData::*pressure) {
  setup.time->step = step;
  const Loads loads(setup);
  const TimeScheme scheme{step};
  State state;
  double sum = 0;
  for (int n = 0; n < loads.steps(); ++n) {
    const StepData data = loads.next(state, scheme);
    sum += (data.time - state.time) * (data.*pressure);
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
  setup.inlet = PressureTable{{{0, 1.332}, {0.125, 1.332}, {0.125, 0}}};
  setup.load = PressureTable{{{0, 0}, {0.3, 2}, {0.7, 2}, {0.9, 0}}};
  for (double step : {0.0125, 0.05, 0.1, 0.3, 0.6, 1.2}) {
    EXPECT_NEAR(impulse(setup, step, &StepData::inlet_pressure), 1.332 * 0.125, 1e-15) << step;
    EXPECT_NEAR(impulse(setup, step, &StepData::wall_pressure), 0.3 + 0.8 + 0.2, 1e-14) << step;
  }
}

TEST(Loads, OfAStepIsTheMeanOverItNotTheValueAtItsEnd) {
  Case setup;
  setup.time = TimeData{};
  setup.time->step = 0.5;
  setup.time->end = 2;
  setup.inlet = PressureTable{{{0, 0}, {2, 4}}};
  const Loads loads(setup);
  EXPECT_EQ(loads.steps(), 4);
  State state;
  state.step = 1;
  const auto data = loads.next(state, TimeScheme{0.5});
  EXPECT_DOUBLE_EQ(data.time, 1.0);
  EXPECT_DOUBLE_EQ(data.inlet_pressure, 1.5);
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
    const auto data = loads.next(state, TimeScheme{});
    EXPECT_DOUBLE_EQ(data.time, 0.25 * (state.step + 1));
    EXPECT_DOUBLE_EQ(data.wall_pressure, 0.2 * (state.step + 1));
    EXPECT_TRUE(data.acceleration_history.empty());
  }
}

}  // namespace

}  // namespace fsi::test
