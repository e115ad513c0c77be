// Pressures that enforce a constraint: a pendulum is to the schemes what an incompressible wall is, a system of index 3.
// Constraint and momentum hold in each balance; order 2 is then no matter of course (docs/theory.md, section 8.9).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "marching.hpp"
#include "time/bdf2.hpp"
#include "time/generalised_alpha.hpp"
#include "time/shifted_midpoint.hpp"
#include "time/tr_bdf2.hpp"

namespace fsi::test {

namespace {

/// x'' + 2 p x = (0, F(t)), |x|^2 = 1, for a wall of one node in the plane; p is its pressure. Solved by Newton's method.
void swing(State& state, const StepData& data) {
  const StepRates& r = data.rates;
  double& x = state.now.wall[0];
  double& y = state.now.wall[1];
  double& p = state.now.wall[2];
  const double c = r.acceleration_factor;
  for (int i = 0; i < 50; ++i) {
    const double fx = c * x + r.acceleration_history[0] + 2 * p * x,
                 fy = c * y + r.acceleration_history[1] + 2 * p * y - data.wall_pressure, g = x * x + y * y - 1;
    const double m = c + 2 * p;  // [m 0 2x; 0 m 2y; 2x 2y 0]
    const double dp = (m * g - 2 * (x * fx + y * fy)) / (4 * (x * x + y * y));
    const double dx = -(fx + 2 * x * dp) / m, dy = -(fy + 2 * y * dp) / m;
    x += dx;
    y += dy;
    p += dp;
    if (std::abs(dx) + std::abs(dy) < 1e-14) break;
  }
}

const PressureTable force{{{0, 3}, {0.5, 3}, {0.5, -1}}};
constexpr double turn = 0.5, final_time = 1;

struct Angle {
  double value = 0, rate = 0;
};

/// After t from the start, by the classical Runge-Kutta method: angle'' = F cos(angle).
Angle exact(double t) {
  Angle now;
  const auto march = [&](double length, double f) {
    const int steps = 200;
    const double h = length / steps;
    const auto slope = [&](const Angle& at) { return Angle{at.rate, f * std::cos(at.value)}; };
    const auto moved = [&](const Angle& by, double s) {
      return Angle{now.value + s * by.value, now.rate + s * by.rate};
    };
    for (int i = 0; i < steps; ++i) {
      const Angle a = slope(now), b = slope(moved(a, h / 2)), c = slope(moved(b, h / 2)), d = slope(moved(c, h));
      now.value += h / 6 * (a.value + 2 * b.value + 2 * c.value + d.value);
      now.rate += h / 6 * (a.rate + 2 * b.rate + 2 * c.rate + d.rate);
    }
  };
  march(std::min(t, turn), 3);
  if (t > turn) march(t - turn, -1);
  return now;
}
double pressure(const Angle& at, double f) {
  return 0.5 * (f * std::sin(at.value) + at.rate * at.rate);
}

struct Errors {
  double position, velocity, pressure;  ///< at the end, pressures settled
  double largest_pressure;              ///< from 0.1 after each jump on
};

/// \param ends  of the steps
Errors errors_of(const TimeIntegrator& scheme, const std::vector<double>& ends) {
  State state = started(scheme, {{}, {}, {1, 0, 0}}, 2);
  Errors errors{};
  const int level = scheme.pressures_lag() ? 1 : 0;
  for (double time : ends) {
    march_step(scheme, state, time, force, swing);
    const double then = state.times[level], since = then > turn ? then - turn : then;
    errors.pressure = std::abs(state.before[level].wall[2] - pressure(exact(then), then > turn ? -1 : 3));
    if (since > 0.1) errors.largest_pressure = std::max(errors.largest_pressure, errors.pressure);
  }
  const Angle at = exact(final_time);
  errors.position = std::hypot(state.now.wall[0] - std::cos(at.value), state.now.wall[1] - std::sin(at.value));
  errors.velocity = std::hypot(state.wall_velocity[0] + at.rate * std::sin(at.value),
                               state.wall_velocity[1] - at.rate * std::cos(at.value));
  return errors;
}

Errors orders(const Errors& coarse, const Errors& fine) {
  return {std::log2(coarse.position / fine.position), std::log2(coarse.velocity / fine.velocity),
          std::log2(coarse.pressure / fine.pressure), std::log2(coarse.largest_pressure / fine.largest_pressure)};
}
Errors orders_of(const TimeIntegrator& scheme, bool uneven) {
  return orders(errors_of(scheme, step_ends({0, turn, final_time}, 60, uneven)),
                errors_of(scheme, step_ends({0, turn, final_time}, 120, uneven)));
}

TEST(ConstrainedMotion, IsOfSecondOrderInPositionVelocityAndPressureThroughAJump) {
  const std::vector<std::shared_ptr<const TimeIntegrator>> schemes = {
      std::make_shared<ShiftedMidpoint<2>>(0.0), std::make_shared<ShiftedMidpoint<2>>(1.0), std::make_shared<Bdf2<2>>(),
      std::make_shared<GeneralisedAlpha<2>>(0.0), std::make_shared<GeneralisedAlpha<2>>(0.5)};
  for (std::size_t i = 0; i < schemes.size(); ++i) {
    const Errors order = orders_of(*schemes[i], false);
    EXPECT_NEAR(order.position, 2, 0.1) << i;
    EXPECT_NEAR(order.velocity, 2, 0.1) << i;
    EXPECT_NEAR(order.pressure, 2, 0.1) << i;
    // Those of the midpoint rule alternate after a jump, by O(dt), until that has died.
    EXPECT_NEAR(order.largest_pressure, i < 2 ? 1.2 : 2, 0.2) << i;
  }
}

// A second difference through unequal steps, as both stages of TR-BDF2 are, has accelerations of first order.
TEST(ConstrainedMotion, PressuresOfBackwardDifferencesWithUnequalStepsAreOfFirstOrder) {
  const std::vector<std::pair<std::shared_ptr<const TimeIntegrator>, bool>> schemes = {
      {std::make_shared<TrBdf2<2>>(), false},
      {std::make_shared<TrBdf2<2>>(), true},
      {std::make_shared<Bdf2<2>>(), true},
      {std::make_shared<GeneralisedAlpha<2>>(0.0), true}};
  for (const auto& [scheme, uneven] : schemes) {
    const Errors order = orders_of(*scheme, uneven);
    EXPECT_NEAR(order.position, 2, 0.1);
    EXPECT_NEAR(order.velocity, 2, 0.1);
    EXPECT_NEAR(order.largest_pressure, 1, 0.1);
  }
}

/// Steps twice as long from the middle of each half on.
std::vector<double> longer_steps(int steps) {
  std::vector<double> ends;
  for (double from : {0.0, turn}) {
    for (int i = 1; i <= steps; ++i) ends.push_back(from + 0.25 * i / steps);
    for (int i = 1; i <= steps / 2; ++i) ends.push_back(i == steps / 2 ? from + 0.5 : from + 0.25 + 0.5 * i / steps);
  }
  return ends;
}

// Where balances lie inside the step, levels keep off the constraint by a multiple of dt^2, which changes with the step.
// Were that left to the next balance, its pressure would be wrong at every step length (docs/theory.md, section 8.9).
TEST(ConstrainedMotion, PressuresComeThroughAChangeOfTheStep) {
  const auto after = [](const TimeIntegrator& scheme) {
    return orders(errors_of(scheme, longer_steps(60)), errors_of(scheme, longer_steps(120)));
  };
  for (double rho : {0.0, 0.5}) {
    const Errors order = after(GeneralisedAlpha<2>(rho));
    EXPECT_NEAR(order.position, 2, 0.1) << rho;
    EXPECT_NEAR(order.velocity, 2, 0.1) << rho;
    EXPECT_NEAR(order.pressure, 2, 0.1) << rho;
    EXPECT_NEAR(order.largest_pressure, 1, 0.1) << rho;
  }
  EXPECT_NEAR(after(Bdf2<2>()).largest_pressure, 1, 0.1);
  // With the midpoint rule what is left, of O(dt), grows for about 1 / (4 damping dt) steps before it dies.
  const Errors midpoint = after(ShiftedMidpoint<2>(1.0));
  EXPECT_NEAR(midpoint.position, 2, 0.1);
  EXPECT_NEAR(midpoint.velocity, 1, 0.1);
  EXPECT_GT(midpoint.largest_pressure, -0.05);
}

/// What TR-BDF2 is not: the midpoint rule up to g dt and then the second backward difference.
class MidpointBdf2 : public BalanceScheme<2> {
 public:
  ErrorTerms error_terms() const override { return {}; }
  int stages(const State&) const override { return 2; }

 private:
  StepRates rates_of(const State& state, double step, int stage) const override {
    const double g = 2 - std::sqrt(2.0);
    if (stage == 1) return TrBdf2<2>::first_rates(*this, state, step, 1);
    StepRates rates = rates_from(step, 2 / (g * step), level(state), state.balances[0]);
    rates.last_stage = false;
    rates.start = state.time;
    rates.end = state.time + g * step;
    rates.time = state.time + 0.5 * g * step;
    rates.carry = 0.5;
    rates.load = {{rates.start, rates.end, 1}};
    return rates;
  }
};

// Its first stage ends off the constraint by O(dt^2), which the second one corrects within a part of the step: an
// acceleration, and so a pressure, that is wrong at every step length.
TEST(ConstrainedMotion, MidpointStageBeforeBackwardDifferencesHasWrongPressuresAtEveryStepLength) {
  const auto ends = [](int steps) { return step_ends({0, turn, final_time}, steps, false); };
  const MidpointBdf2 refused;
  const Errors coarse = errors_of(refused, ends(60)), fine = errors_of(refused, ends(240));
  const double largest = pressure(exact(turn), 3);
  EXPECT_GT(coarse.largest_pressure, largest);
  EXPECT_NEAR(fine.largest_pressure, coarse.largest_pressure, 0.1 * coarse.largest_pressure);
  const Errors of_tr_bdf2 = errors_of(TrBdf2<2>(), ends(240));
  EXPECT_LT(of_tr_bdf2.largest_pressure, 0.005 * largest);
}

}  // namespace

}  // namespace fsi::test
