// Schemes with balances step by step: their formulas with numbers put in by hand, their stages, their pressures.

#include "time/balance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "marching.hpp"
#include "time/bdf2.hpp"
#include "time/generalised_alpha.hpp"
#include "time/shifted_midpoint.hpp"
#include "time/tr_bdf2.hpp"

namespace fsi::test {

namespace {

const double root = std::sqrt(2.0);

/// A node of each, at time 1 after a step of 0.25 from level to level.
State at_work(const TimeIntegrator& scheme) {
  State state = started(scheme, {{0}, {0, 0}, {0, 0}}, 1);
  state.step = 7;
  state.time = 1;
  state.times = {1, 0.75, 0.5};
  state.since_jump = 3;
  state.before[1] = {{1}, {2, -20}, {3, -30}};
  state.before[0] = state.now = {{5}, {7, -70}, {11, -110}};
  state.wall_velocity_before = {4};
  state.wall_velocity = {13};
  state.balances[0].fluid = {0.5, 17};
  state.balances[0].wall = {0.5, 19};
  return state;
}

TEST(ShiftedMidpoint, FormulasByHand) {
  // dt = 0.5, theta = 0.5 + 0.2 * 0.5 = 0.6, k = 1/0.3
  const ShiftedMidpoint<1> scheme(0.2);
  State state = at_work(scheme);
  StepData data;
  data.time = 1.5;
  data.rates = scheme.rates(state, 0.5);
  const StepRates& r = data.rates;
  EXPECT_EQ(scheme.stages(state), 1);
  EXPECT_TRUE(r.last_stage);
  EXPECT_EQ(r.step, 0.5);
  EXPECT_NEAR(r.time, 1.3, 1e-15);
  EXPECT_EQ(r.end, 1.5);
  EXPECT_NEAR(r.carry, 0.6, 1e-15);
  EXPECT_NEAR(r.interface.rate(), 1 / 0.3, 1e-14);
  EXPECT_NEAR(r.fluid_factor, 1 / 0.3, 1e-14);
  EXPECT_NEAR(r.acceleration_factor, 1 / 0.09, 1e-13);
  EXPECT_NEAR(r.acceleration_history[0], -11 / 0.09 - 13 / 0.3, 1e-12);
  EXPECT_EQ(r.mesh_reference, (std::vector<double>{5}));
  EXPECT_EQ(r.fluid_reference, (std::vector<double>{7, 17})) << "with the last balance's pressure";
  EXPECT_EQ(r.wall_reference, (std::vector<double>{11, 19}));
  ASSERT_EQ(r.load.size(), 1u);
  EXPECT_EQ(r.load[0].from, 1);
  EXPECT_EQ(r.load[0].to, 1.5);
  EXPECT_EQ(r.load[0].weight, 1);

  // Values there 0.6 more than at the last level: one more at the end; v at the balance 0.6/0.3 = 2.
  state.now = {{5.6}, {7.6, 100}, {11.6, 200}};
  scheme.accept(state, data);
  EXPECT_NEAR(state.before[0].mesh[0], 6, 1e-14);
  EXPECT_NEAR(state.before[0].fluid[0], 8, 1e-14);
  EXPECT_NEAR(state.before[0].wall[0], 12, 1e-14);
  EXPECT_NEAR(state.wall_velocity[0], 13 + (2 - 13) / 0.6, 1e-12);
  EXPECT_EQ(state.wall_velocity_before[0], 13);
  EXPECT_NEAR(state.wall_acceleration[0], (2 - 13) / 0.3, 1e-12);
  EXPECT_EQ(state.balances[0].fluid, (std::vector<double>{7.6, 100}));
  EXPECT_NEAR(state.balance_times[0], 1.3, 1e-15);
  EXPECT_EQ(state.before[1].mesh[0], 5);
  EXPECT_EQ(state.step, 8);
  EXPECT_EQ(state.time, 1.5);
  EXPECT_EQ(state.since_jump, 4);
}

TEST(Bdf2, FormulasByHand) {
  // dt = 0.5 after 0.25: q = 2, k = 5/(3 0.5) = 10/3, r = (9 y^n - 4 y^(n-1))/5
  const Bdf2<1> scheme;
  const StepRates r = scheme.rates(at_work(scheme), 0.5);
  EXPECT_EQ(r.time, 1.5);
  EXPECT_EQ(r.carry, 1);
  EXPECT_NEAR(r.fluid_factor, 10.0 / 3, 1e-14);
  EXPECT_NEAR(r.mesh_reference[0], (9 * 5 - 4 * 1) / 5.0, 1e-14);
  EXPECT_NEAR(r.fluid_reference[0], (9 * 7 - 4 * 2) / 5.0, 1e-14);
  const double d = (9 * 11 - 4 * 3) / 5.0, v = (9 * 13 - 4 * 4) / 5.0;
  EXPECT_NEAR(r.wall_reference[0], d, 1e-13);
  EXPECT_NEAR(r.acceleration_history[0], -100.0 / 9 * d - 10.0 / 3 * v, 1e-12);
  // k dt = 5/3 of the step's mean, q^2/(1 + q) 0.25/0.5 = 2/3 of the last one's less
  ASSERT_EQ(r.load.size(), 2u);
  EXPECT_NEAR(r.load[0].weight, 5.0 / 3, 1e-14);
  EXPECT_EQ(r.load[1].from, 0.75);
  EXPECT_EQ(r.load[1].to, 1);
  EXPECT_NEAR(r.load[1].weight, -2.0 / 3, 1e-14);
}

TEST(Bdf2, BeginsWithTwoStagesAfterAJump) {
  const Bdf2<1> scheme;
  State state = at_work(scheme);
  EXPECT_EQ(scheme.stages(state), 1);
  state.since_jump = 0;
  EXPECT_EQ(scheme.stages(state), 2);
  const StepRates own = scheme.rates(state, 0.5), other = TrBdf2<1>().rates(state, 0.5);
  EXPECT_EQ(own.fluid_factor, other.fluid_factor);
  EXPECT_EQ(own.acceleration_history, other.acceleration_history);
  EXPECT_FALSE(own.last_stage);
}

// Equal steps whose times are rounded have the same factors, so that Jacobians made for one serve the others.
TEST(Schemes, WithMemoryHaveTheFactorsOfEqualStepsWhateverTheRoundingOfTimes) {
  State state = at_work(Bdf2<1>());
  state.times = {0.3, 0.2, 0.1};
  state.time = 0.3;
  ASSERT_NE(0.3 - 0.2, 0.1);
  EXPECT_EQ(Bdf2<1>().rates(state, 0.1).fluid_factor, (1 + 2.0) / ((1 + 1.0) * 0.1));
  State prepared = at_work(GeneralisedAlpha<1>(0.5));
  const double equal = GeneralisedAlpha<1>(0.5).rates(prepared, 0.25).fluid_factor;
  prepared.times[1] = std::nextafter(0.75, 1);
  EXPECT_EQ(GeneralisedAlpha<1>(0.5).rates(prepared, 0.25).fluid_factor, equal);
}

TEST(TrBdf2, FormulasByHand) {
  const TrBdf2<1> scheme;
  const double g = 2 - root;
  State state = at_work(scheme);
  state.rate = {{2}, {3, 0}, {13, 0}};
  state.velocity_rate = {-6};
  state.load_rates = {0.5, 0.25};
  StepData data;
  data.time = 1.5;
  data.rates = scheme.rates(state, 0.5);
  // Trapezoidal rule over g/2: y = r + y'/k with k = 2/(g dt), r = y^n + y'^n/k
  const double k = 4 / g;
  EXPECT_EQ(scheme.stages(state), 2);
  EXPECT_NEAR(data.rates.fluid_factor, k, 1e-13);
  EXPECT_NEAR(data.rates.mesh_reference[0], 5 + 2 / k, 1e-13);
  EXPECT_NEAR(data.rates.fluid_reference[0], 7 + 3 / k, 1e-13);
  EXPECT_NEAR(data.rates.wall_reference[0], 11 + 13 / k, 1e-13);
  EXPECT_NEAR(data.rates.acceleration_history[0], -k * k * (11 + 13 / k) - k * (13 - 6 / k), 1e-11);
  EXPECT_EQ(data.rates.load_rate_weight, -1);
  EXPECT_NEAR(data.rates.load[0].weight, 2, 1e-15);
  EXPECT_FALSE(data.rates.last_stage);
  state.now = {{6}, {8, 300}, {12, 400}};
  scheme.accept(state, data);
  EXPECT_NEAR(state.stage_velocity[0], k * (12 - 11 - 13 / k), 1e-12);

  // y = (y_g - (1 - g)^2 y^n) / (1 - (1 - g)^2) + y'/k, 1 - g = sqrt(2) - 1, (1 - g)^2 = 3 - 2 sqrt(2)
  data.rates = scheme.rates(state, 0.5, 1);
  const double old = 3 - 2 * root;
  EXPECT_NEAR(data.rates.fluid_factor, k, 1e-13) << "one Jacobian for both stages";
  EXPECT_NEAR(data.rates.fluid_factor, (2 - g) / ((1 - g) * 0.5), 1e-12);
  EXPECT_NEAR(data.rates.mesh_reference[0], (6 - old * 5) / (1 - old), 1e-13);
  EXPECT_NEAR(data.rates.fluid_reference[0], (8 - old * 7) / (1 - old), 1e-13);
  EXPECT_EQ(data.rates.fluid_reference[1], 300) << "with the first stage's pressure";
  EXPECT_TRUE(data.rates.last_stage);
  data.opening_pressures = {1};
  data.wall_pressure = 2;
  state.now = {{7}, {9, 500}, {13, 600}};
  const double reference = data.rates.fluid_reference[0];
  scheme.accept(state, data);
  EXPECT_EQ(state.before[0].fluid, (std::vector<double>{9, 500}));
  EXPECT_NEAR(state.rate.fluid[0], k * (9 - reference), 1e-12);
  EXPECT_EQ(state.load_rates, (std::vector<double>{1, 2}));
  EXPECT_EQ(state.balances[1].fluid, (std::vector<double>{8, 300})) << "the first stage's";
  EXPECT_NEAR(state.balance_times[1], 1 + 0.5 * g, 1e-15);
}

TEST(GeneralisedAlpha, FormulasByHand) {
  // rho = 1/2: a_m = 5/6, a_f = 2/3, g = 2/3 with equal steps; k = 5/6 / (4/9 0.25) = 7.5, 1 - a_m/g = -1/4
  const GeneralisedAlpha<1> scheme(0.5);
  State state = at_work(scheme);
  state.rate = {{2}, {3, 0}, {13, 0}};
  state.velocity_rate = {-6};
  state.load_rates = {0.5, 0.25};
  StepData data;
  data.time = 1.25;
  data.rates = scheme.rates(state, 0.25);
  const StepRates& r = data.rates;
  EXPECT_NEAR(r.fluid_factor, 7.5, 1e-13);
  EXPECT_NEAR(r.carry, 2.0 / 3, 1e-15);
  EXPECT_NEAR(r.time, 1 + 0.5 / 3, 1e-15);
  EXPECT_NEAR(r.mesh_reference[0], 5 + 0.25 * 2 / 7.5, 1e-14);
  EXPECT_NEAR(r.fluid_reference[0], 7 + 0.25 * 3 / 7.5, 1e-14);
  EXPECT_NEAR(r.load[0].weight, 1.25, 1e-14);
  EXPECT_NEAR(r.load_rate_weight, -0.25, 1e-14);

  // u rises by 2/3, by 1 at the end: u' = 1/(2/3 0.25) - 1/2 3 = 4.5. The load: (0.8 - 0.5/6) / (5/6) = 0.86.
  state.now.fluid[0] = 7 + 2.0 / 3;
  data.opening_pressures = {0.8};
  scheme.accept(state, data);
  EXPECT_NEAR(state.before[0].fluid[0], 8, 1e-14);
  EXPECT_NEAR(state.rate.fluid[0], 4.5, 1e-13);
  EXPECT_NEAR(state.load_rates[0], 0.86, 1e-14);
}

// A stage is solved, the next one fails: the state's finished levels and what schemes keep of them are as before, and the
// step can be taken again, also with another length.
TEST(Stages, LeaveFinishedLevelsAloneUntilTheLast) {
  for (int which : {0, 1}) {
    std::unique_ptr<const TimeIntegrator> scheme = std::make_unique<TrBdf2<1>>();
    if (which == 1) scheme = std::make_unique<Bdf2<1>>();
    State state = at_work(*scheme);
    state.since_jump = which == 0 ? 3 : 0;
    if (which == 0) {
      state.rate = {{2}, {3, 0}, {13, 0}};
      state.velocity_rate = {-6};
    }
    const auto solve = [](State& at, const StepData& data) {
      for (double& x : at.now.wall) x = 0.3 * data.rates.wall_reference[0];
      for (double& x : at.now.fluid) x = 0.2 * data.rates.fluid_reference[0];
      for (double& x : at.now.mesh) x = 0.1 * data.rates.mesh_reference[0];
    };
    State disturbed = state;
    StepData data;
    data.time = 1.5;
    data.rates = scheme->rates(disturbed, 0.5);
    disturbed.now = {{6}, {8, 300}, {12, 400}};
    scheme->accept(disturbed, data);
    for (int level = 0; level < 3; ++level) {
      EXPECT_EQ(disturbed.before[level].wall, state.before[level].wall);
      EXPECT_EQ(disturbed.before[level].fluid, state.before[level].fluid);
      EXPECT_EQ(disturbed.before[level].mesh, state.before[level].mesh);
      EXPECT_EQ(disturbed.balances[level].wall, state.balances[level].wall);
      EXPECT_EQ(disturbed.balances[level].fluid, state.balances[level].fluid);
    }
    EXPECT_EQ(disturbed.step, state.step);
    EXPECT_EQ(disturbed.time, state.time);
    EXPECT_EQ(disturbed.times, state.times);
    EXPECT_EQ(disturbed.balance_times, state.balance_times);
    EXPECT_EQ(disturbed.since_jump, state.since_jump);
    EXPECT_EQ(disturbed.balances_since_jump, state.balances_since_jump);
    EXPECT_EQ(disturbed.wall_velocity, state.wall_velocity);
    EXPECT_EQ(disturbed.wall_acceleration, state.wall_acceleration);
    EXPECT_EQ(disturbed.rate.fluid, state.rate.fluid);
    EXPECT_EQ(disturbed.load_rates, state.load_rates);
    disturbed.now = disturbed.before[0];
    march_step(*scheme, disturbed, 1.25, {}, solve);
    march_step(*scheme, state, 1.25, {}, solve);
    EXPECT_EQ(disturbed.now.wall, state.now.wall);
    EXPECT_EQ(disturbed.now.fluid, state.now.fluid);
    EXPECT_EQ(disturbed.wall_velocity, state.wall_velocity);
  }
}

// Pressures belong to balances. A linear course is brought to the levels exactly, whatever the steps; not through a jump.
TEST(Pressures, AreBroughtToTheLevelsFromBalances) {
  const PressureTable load{{{0, 1}, {1, 1}, {1, 0}}};
  std::vector<std::unique_ptr<const TimeIntegrator>> schemes;
  schemes.push_back(std::make_unique<ShiftedMidpoint<1>>(0.3));
  schemes.push_back(std::make_unique<GeneralisedAlpha<1>>(0.5));
  schemes.push_back(std::make_unique<TrBdf2<1>>());
  schemes.push_back(std::make_unique<Bdf2<1>>());
  for (const auto& scheme : schemes) {
    State state = started(*scheme, {{0}, {0, 0}, {0, 0}}, 1);
    const auto pressure = [](double t) { return t < 1 + 1e-9 ? 3 + 2 * t : -5 - 4 * t; };
    const auto set = [&](State& at, const StepData& data) {
      const bool after = data.rates.start > 1 - 1e-9;
      const double p = after ? -5 - 4 * data.rates.time : 3 + 2 * data.rates.time;
      at.now.fluid[1] = p;
      at.now.wall[1] = -p;
    };
    int i = 0;
    for (double until : {0.2, 0.5, 0.6, 1.0, 1.3, 1.5, 1.9}) {
      ++i;
      march_step(*scheme, state, until, load, set);
      const bool first = i == 1 || i == 5;  // after a jump: of its balance alone, until the next is known
      if (!(first && scheme->pressures_lag())) {
        EXPECT_NEAR(state.before[0].fluid[1], pressure(until), 1e-12) << until;
        EXPECT_NEAR(state.before[0].wall[1], -pressure(until), 1e-12) << until;
      }
      if (i > 1) {
        EXPECT_NEAR(state.before[1].fluid[1], pressure(state.times[1]), 1e-12) << until;
      }
    }
  }
}

// They stay as they are exactly where the next step does not change them: where the load jumps, or a balance lies at the
// level (theta = 1).
TEST(Pressures, AreSettledWhereTheNextStepLeavesThem) {
  const PressureTable load{{{0, 1}, {1, 1}, {1, 0}}};
  const ShiftedMidpoint<1> inside(0.3), at_end(5);
  const GeneralisedAlpha<1> alpha(0.5);
  for (const TimeIntegrator* scheme :
       {static_cast<const TimeIntegrator*>(&inside), static_cast<const TimeIntegrator*>(&at_end),
        static_cast<const TimeIntegrator*>(&alpha)}) {
    ASSERT_TRUE(scheme->pressures_lag());
    State state = started(*scheme, {{0}, {0, 0}, {0, 0}}, 1);
    const auto set = [](State& at, const StepData& data) {
      at.now.fluid[1] = data.rates.time * data.rates.time;
      at.now.wall[1] = -at.now.fluid[1];
    };
    bool settled = true;
    double fluid = 0, wall = 0;
    int changed = 0;
    for (double until : {0.2, 0.5, 0.8, 1.0, 1.3, 1.5, 1.9}) {
      const bool first = state.step == 0;
      march_step(*scheme, state, until, load, set);
      if (!first && settled) {
        EXPECT_EQ(state.before[1].fluid[1], fluid) << until;
        EXPECT_EQ(state.before[1].wall[1], wall) << until;
      } else if (!first) {
        changed += state.before[1].fluid[1] != fluid && state.before[1].wall[1] != wall;
      }
      settled = pressures_settled(state);
      fluid = state.before[0].fluid[1];
      wall = state.before[0].wall[1];
      EXPECT_EQ(settled, scheme == &at_end || until == 1.0) << until;
    }
    EXPECT_EQ(changed, scheme == &at_end ? 0 : 5);
  }
}

}  // namespace

}  // namespace fsi::test
