// Pressures that enforce a constraint: a pendulum is to the schemes what an incompressible wall is, a system of index 3.
// Constraint and momentum hold in each balance; order 2 is then no matter of course (docs/theory.md, section 8.9).

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
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
constexpr double jump = 0.5, end = 1;

struct Angle {
  double value = 0, rate = 0;
};

/// After t from the start, by the classical Runge-Kutta method: angle'' = F cos(angle).
Angle exact(double t) {
  Angle now;
  const auto march = [&](double length, double f) {
    const int steps = 2000;
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
  march(std::min(t, jump), 3);
  if (t > jump) march(t - jump, -1);
  return now;
}
double pressure(const Angle& at, double f) {
  return 0.5 * (f * std::sin(at.value) + at.rate * at.rate);
}

/// Errors of position, velocity and settled pressure at the end; the largest of the pressure a fifth of the time after
/// each jump.
std::array<double, 4> errors_of(const TimeIntegrator& scheme, int steps, bool uneven) {
  State state = started(scheme, {{}, {}, {1, 0, 0}}, 2);
  std::array<double, 4> errors{};
  for (double time : step_ends({0, jump, end}, steps, uneven)) {
    march_step(scheme, state, time, force, swing);
    const int level = scheme.pressures_lag() ? 1 : 0;
    const double then = state.times[level], since = then > jump ? then - jump : then;
    errors[2] = std::abs(state.before[level].wall[2] - pressure(exact(then), then > jump ? -1 : 3));
    if (since > 0.1) errors[3] = std::max(errors[3], errors[2]);
  }
  const Angle at = exact(end);
  errors[0] = std::hypot(state.now.wall[0] - std::cos(at.value), state.now.wall[1] - std::sin(at.value));
  errors[1] = std::hypot(state.wall_velocity[0] + at.rate * std::sin(at.value),
                         state.wall_velocity[1] - at.rate * std::cos(at.value));
  return errors;
}

class ConstrainedMotion : public testing::TestWithParam<int> {
 protected:
  static std::shared_ptr<const TimeIntegrator> scheme() {
    switch (GetParam()) {
      case 0:
        return std::make_shared<ShiftedMidpoint<2>>(0.0);
      case 1:
        return std::make_shared<ShiftedMidpoint<2>>(1.0);
      case 2:
        return std::make_shared<Bdf2<2>>();
      case 3:
        return std::make_shared<TrBdf2<2>>();
      case 4:
        return std::make_shared<GeneralisedAlpha<2>>(0.0);
      default:
        return std::make_shared<GeneralisedAlpha<2>>(0.5);
    }
  }
};
INSTANTIATE_TEST_SUITE_P(Schemes, ConstrainedMotion, testing::Range(0, 6));

TEST_P(ConstrainedMotion, IsOfSecondOrderInPositionVelocityAndPressureThroughAJump) {
  const auto integrator = scheme();
  for (bool uneven : {false, true}) {
    const auto coarse = errors_of(*integrator, 60, uneven), fine = errors_of(*integrator, 120, uneven);
    const char* names[] = {"position", "velocity", "pressure", "pressure, largest"};
    for (int i = 0; i < 4; ++i) {
      const double order = std::log2(coarse[i] / fine[i]);
      printf("%d %d %s %g %g %.3f\n", GetParam(), uneven, names[i], coarse[i], fine[i], order);
      EXPECT_NEAR(order, 2, 0.2) << names[i] << (uneven ? ", unequal steps" : "");
    }
  }
}

/// What TR-BDF2 is not: the midpoint rule up to g dt and then the second backward difference.
class MidpointBdf2 : public BalanceScheme<2> {
 public:
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
// acceleration, and so a pressure, that does not fall with the step. Position and velocity do not show it.
TEST(MidpointFollowedByBackwardDifferences, HasPressuresThatAreWrongAtEveryStepLength) {
  const MidpointBdf2 scheme;
  const auto coarse = errors_of(scheme, 60, false), fine = errors_of(scheme, 240, false);
  printf("sdirk %g %g %g %g\n", coarse[0], coarse[1], coarse[2], coarse[3]);
  printf("sdirk %g %g %g %g\n", fine[0], fine[1], fine[2], fine[3]);
  const double largest = pressure(exact(jump), 3);
  EXPECT_GT(coarse[3], 0.05 * largest);
  EXPECT_GT(fine[3], 0.9 * coarse[3]);
  EXPECT_LT(fine[0], coarse[0] / 12);
}

}  // namespace

}  // namespace fsi::test
