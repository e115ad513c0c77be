#include "time/error_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "time/shifted_midpoint.hpp"

namespace fsi::test {

namespace {

/// One node of a wall in a plane whose displacement is t^3 in one direction, and its pressure t^2, at each balance.
class Cubic : public testing::Test {
 protected:
  void SetUp() override {
    state_.now.wall.assign(3, 0.0);
    state_.before = {state_.now, state_.now, state_.now};
    state_.wall_velocity.assign(2, 0.0);
    state_.wall_acceleration.assign(2, 0.0);
    scheme_.prepare(state_);
  }
  /// The errors that the estimate finds in a step to `time`.
  StepErrors step(double time, bool accept = true) {
    StepData data;
    data.time = time;
    data.rates = scheme_.rates(state_, time - state_.time);
    const double theta = data.rates.carry, t0 = state_.time;
    EXPECT_NEAR(theta, 0.5 + 0.1 * (time - t0), 1e-12);
    state_.now.wall = {std::pow(data.rates.time, 3), 0, data.rates.time * data.rates.time};
    const StepErrors errors = estimate_.of(state_, data);
    if (accept) {
      estimate_.accept(data);
      scheme_.accept(state_, data);
    }
    return errors;
  }

  State state_;
  ShiftedMidpoint<2> scheme_{0.1};
  ErrorEstimate<2> estimate_{{}, {2.0}, {2, 1.0 / 12, 0}, 5.0};
};

TEST_F(Cubic, IsTheSchemesErrorForStepsOfAnyLengths) {
  for (const double time : {0.2, 0.3, 0.4}) EXPECT_FALSE(step(time).known);
  for (const double time : {0.6, 0.7, 1.0, 1.1}) {
    const double dt = time - state_.time;
    const StepErrors errors = step(time);
    ASSERT_TRUE(errors.known);
    EXPECT_NEAR(errors.displacement, 5 / dt * dt * dt * dt / 12 * 6 / state_.before[0].wall[0], 1e-10) << time;
    const double balance = state_.balance_times[0];
    EXPECT_NEAR(errors.pressure, dt * dt / 12 * 2 / (balance * balance), 1e-10) << time;
    EXPECT_EQ(errors.velocity, 0);
  }
}

TEST_F(Cubic, KnowsNothingOfARejectedStep) {
  for (const double time : {0.2, 0.3, 0.4, 0.5}) step(time);
  const StepErrors first = step(0.6);
  State before = state_;
  step(5, false);
  state_ = before;
  ErrorEstimate<2> again({}, {2.0}, {2, 1.0 / 12, 0}, 5.0);
  WrittenArchive archive = archive_of(estimate_);
  again.keep(archive.turn());
  estimate_ = again;
  EXPECT_LT(step(0.7).displacement, first.displacement);
}

}  // namespace

}  // namespace fsi::test
