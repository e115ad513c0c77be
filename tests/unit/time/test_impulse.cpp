// The impulse of a load in the discrete balances, for every scheme and any table (docs/theory.md, section 8.9).

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "scene/loads.hpp"
#include "time/bdf2.hpp"
#include "time/euler_newmark.hpp"
#include "time/generalised_alpha.hpp"
#include "time/shifted_midpoint.hpp"
#include "time/tr_bdf2.hpp"

namespace fsi::test {

namespace {

/// A ramp, a pulse of one step and of less than one, a jump of the sign, a kink.
const PressureTable table{{{0, 0.3},
                           {0.2, 1.4},
                           {0.2, -0.5},
                           {0.37, 0.8},
                           {0.37, 1.5},
                           {0.4, 1.5},
                           {0.4, 0},
                           {0.9, 0},
                           {1.05, 1},
                           {1.3, 0.2}}};

double impulse_until(double time) {
  return time * table.mean(0, time);
}

using Scheme = std::pair<std::string, std::shared_ptr<const TimeIntegrator>>;

std::vector<Scheme> schemes() {
  return {{"euler", std::make_shared<EulerNewmark<1>>()},
          {"midpoint", std::make_shared<ShiftedMidpoint<1>>(0.9)},
          {"bdf2", std::make_shared<Bdf2<1>>()},
          {"generalised-alpha, 0", std::make_shared<GeneralisedAlpha<1>>(0.0)},
          {"generalised-alpha, 0.5", std::make_shared<GeneralisedAlpha<1>>(0.5)},
          {"generalised-alpha, 0.8", std::make_shared<GeneralisedAlpha<1>>(0.8)},
          {"tr-bdf2", std::make_shared<TrBdf2<1>>()}};
}

/// One node of fluid and one of a wall, each free, with the mass 1 and its own load.
struct Masses {
  State state;
  double impulse = 0;  ///< of the balances' loads by their weights

  explicit Masses(const TimeIntegrator& scheme) {
    state.now.fluid = state.now.wall = {0, 0};  // velocity or displacement, and pressure
    state.before = {state.now, state.now, state.now};
    state.wall_velocity = state.wall_acceleration = {0};
    scheme.prepare(state);
    if (!state.velocity_rate.empty()) state.load_rates.assign(3, 0.0);  // inlet, outlet, wall
  }

  void advance(const TimeIntegrator& scheme, const Loads& loads) {
    const double before = state.load_rates.empty() ? 0 : state.load_rates.back();
    const int stages = scheme.stages(state);
    for (int stage = 0; stage < stages; ++stage) {
      const StepData data = loads.next(state, scheme, stage);
      const StepRates& rates = data.rates;
      impulse += rates.step * (rates.weight * data.wall_pressure + rates.previous_weight * before);
      scheme.predict(state, 0, data);
      state.now.fluid[0] = rates.fluid_reference[0] + data.opening_pressures[0] / rates.fluid_factor;
      state.now.wall[0] = (data.wall_pressure - rates.acceleration_history[0]) / rates.acceleration_factor;
      scheme.accept(state, data);
    }
  }
};

Case case_of(double step) {
  Case setup;
  setup.time = TimeData{};
  setup.time->step = step;
  setup.time->end = 1.25;
  setup.fluid = FluidData{};
  setup.inlet = setup.load = table;
  return setup;
}

// Steps between the jumps have lengths of their own, and the last one is shorter.
TEST(Impulse, OfAnyTableIsTheMomentumOfAFreeMassAtEveryLevel) {
  for (const auto& [name, scheme] : schemes())
    for (const double step : {0.1, 0.04, 0.0137}) {
      const Case setup = case_of(step);
      const Loads loads(setup);
      Masses masses(*scheme);
      const double rounding = 4e-13 + 1e-14 / step;  // times have twelve digits; differences are taken over a step
      while (masses.state.step < loads.steps()) {
        masses.advance(*scheme, loads);
        const double exact = impulse_until(masses.state.time);
        EXPECT_NEAR(masses.state.now.fluid[0], exact, rounding) << name << ", step " << masses.state.step;
        EXPECT_NEAR(masses.state.wall_velocity[0], exact, rounding) << name << ", step " << masses.state.step;
      }
      EXPECT_EQ(masses.state.time, setup.time->end);
    }
}

// As on a restart with another time.step, in the middle of a ramp and before a jump.
TEST(Impulse, IsTheMomentumAlsoWhereTheStepChangesWithoutAJump) {
  for (const auto& [name, scheme] : schemes()) {
    const Case first = case_of(0.05), second = case_of(0.021), third = case_of(0.06);
    std::vector<std::unique_ptr<Loads>> loads;
    Masses masses(*scheme);
    for (const auto& [setup, until] : {std::pair(&first, 0.1), {&second, 0.48}, {&third, 1.25}}) {
      auto next = std::make_unique<Loads>(*setup);
      if (!loads.empty()) next->axis().go_on(loads.back()->axis().stretches(), masses.state.step, masses.state.time);
      loads.push_back(std::move(next));
      while (masses.state.time < until - 1e-9) {
        masses.advance(*scheme, *loads.back());
        const double exact = impulse_until(masses.state.time);
        EXPECT_NEAR(masses.state.now.fluid[0], exact, 1e-13) << name << ", step " << masses.state.step;
        EXPECT_NEAR(masses.state.wall_velocity[0], exact, 1e-13) << name << ", step " << masses.state.step;
      }
    }
    EXPECT_EQ(masses.state.time, 1.25);
  }
}

// Of schemes without a history of rates the loads of the balances add up to it by their weights.
TEST(Impulse, OfAnyTableIsTheSumOfLoadsByTheirWeights) {
  for (const auto& [name, scheme] : schemes()) {
    if (name != "euler" && name != "midpoint" && name != "tr-bdf2") continue;
    for (const double step : {0.1, 0.0137}) {
      const Case setup = case_of(step);
      const Loads loads(setup);
      Masses masses(*scheme);
      while (masses.state.step < loads.steps()) {
        masses.advance(*scheme, loads);
        EXPECT_NEAR(masses.impulse, impulse_until(masses.state.time), 1e-14) << name << ", step " << masses.state.step;
      }
    }
  }
}

// What the history of rates adds dies: after the last change of the load the balance's load is the table's value.
TEST(Impulse, LoadsOfBalancesSettleOnAConstantTable) {
  Case setup = case_of(0.01);
  setup.inlet = setup.load = PressureTable{{{0, 2}, {0.3, 2}, {0.3, -1}}};
  const Loads loads(setup);
  for (const auto& [name, scheme] : schemes()) {
    Masses masses(*scheme);
    double last = 0;
    while (masses.state.step < loads.steps()) {
      last = loads.next(masses.state, *scheme).wall_pressure;
      masses.advance(*scheme, loads);
    }
    EXPECT_NEAR(last, -1, 1e-6) << name;
  }
}

}  // namespace

}  // namespace fsi::test
