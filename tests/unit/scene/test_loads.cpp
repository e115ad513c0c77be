#include <gtest/gtest.h>

#include "scene/loads.hpp"
#include "time/euler_newmark.hpp"

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

// Of supports: pressure and traction components, by surface in the order of their names.
TEST(Loads, OfSupportsKeepTheirImpulse) {
  Case setup;
  setup.time = TimeData{};
  setup.time->end = 1.2;
  setup.supports["outer"].pressure = PressureTable{{{0, 0}, {0.3, 2}, {0.7, 2}, {0.9, 0}}};
  setup.supports["end"].traction = {PressureTable{{{0, 3}}}, PressureTable{{{0, 1}, {0.125, 1}, {0.125, 0}}}};
  const double expected[] = {3 * 1.2, 0.125, 1.3};
  for (double step : {0.05, 0.3, 1.2})
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(impulse(setup, step, [i](const StepData& data) { return data.support_loads.at(i); }), expected[i],
                  1e-14)
          << step;
  EXPECT_TRUE(Loads(setup).axis().jumps_at(0.125));
  EXPECT_EQ(support_loads_at_rest(setup), (std::vector<double>{3, 1, 0})) << "as the run begins";
}

TEST(Loads, StaticLoadsOfSupportsAreThereFromTheStartUnderPrestress) {
  Case setup;
  setup.static_load = StaticData{4};
  setup.load = PressureTable{{{0, 0.8}}};
  setup.supports["outer"].pressure = PressureTable{{{0, 0.4}}};
  State state;
  state.step = 1;
  EXPECT_DOUBLE_EQ(Loads(setup).next(state, QuasiStatic()).support_loads.at(0), 0.2);
  EXPECT_DOUBLE_EQ(Loads(setup).next(state, QuasiStatic()).wall_pressure, 0.4);
  setup.prestress.emplace().pressure = 0.6;
  EXPECT_DOUBLE_EQ(Loads(setup).next(state, QuasiStatic()).support_loads.at(0), 0.4);
  EXPECT_DOUBLE_EQ(Loads(setup).next(state, QuasiStatic()).wall_pressure, 0.7) << "from the prestress on";
  EXPECT_EQ(support_loads_at_rest(setup), std::vector<double>{0.4});
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
