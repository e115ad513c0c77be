// The time schemes of second order on linear motions with exact solutions (docs/theory.md, sections 8.4 to 8.8).

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <set>
#include <string>

#include "marching.hpp"
#include "time/bdf2.hpp"
#include "time/generalised_alpha.hpp"
#include "time/shifted_midpoint.hpp"
#include "time/time_schemes.hpp"
#include "time/tr_bdf2.hpp"

namespace fsi::test {

namespace {

/// A wall of one node, a fluid of one node and its mesh, which moves with it:
///   d'' + 2 c d' + w^2 d = p(t),   u' + l u = p(t),   m' = u,   and p_s = d, p_f = u as pressures.
struct LinearMotion {
  double damping = 0.3, frequency = 4, decay = 2;  ///< c, w, l, 1/ms
  PressureTable load;

  void operator()(State& state, const StepData& data) const {
    const StepRates& r = data.rates;
    const double k = r.interface.rate(), c = damping;
    const double d = (data.wall_pressure - r.acceleration_history[0] + 2 * c * k * r.wall_reference[0]) /
                     (r.acceleration_factor + 2 * c * k + frequency * frequency);
    const double u = (data.opening_pressures[0] + r.fluid_factor * r.fluid_reference[0]) / (r.fluid_factor + decay);
    state.now.wall = {d, d};
    state.now.fluid = {u, u};
    state.now.mesh = {r.interface.displacement(u, r.mesh_reference[0])};
  }
};

struct Values {
  double d = 0, v = 0, u = 0, m = 0;
};

/// After a time t under a constant load.
Values moved(const LinearMotion& motion, const Values& from, double load, double t) {
  const double c = motion.damping, w2 = motion.frequency * motion.frequency, w = std::sqrt(w2 - c * c);
  const double a = from.d - load / w2, b = (from.v + c * a) / w;
  const double cosine = std::cos(w * t), sine = std::sin(w * t), fall = std::exp(-c * t);
  const double l = motion.decay, rest = from.u - load / l, left = std::exp(-l * t);
  return {load / w2 + fall * (a * cosine + b * sine), fall * ((w * b - c * a) * cosine - (w * a + c * b) * sine),
          load / l + rest * left, from.m + load / l * t + rest * (1 - left) / l};
}

constexpr double jump = 0.75, end = 1.5;  // ms
constexpr double first_load = 5, second_load = -2;

Values exact(const LinearMotion& motion, double t) {
  const Values start;
  if (t <= jump) return moved(motion, start, first_load, t);
  return moved(motion, moved(motion, start, first_load, jump), second_load, t - jump);
}

constexpr std::array<const char*, 6> quantities = {"d", "v", "u", "m", "p_s", "p_f"};

/// Largest errors of all levels, of pressures that are settled (pressures_lag), from rest and through a jump of the load.
std::array<double, 6> errors_of(const TimeIntegrator& scheme, int steps, bool uneven) {
  LinearMotion motion;
  motion.load.points = {{0, first_load}, {jump, first_load}, {jump, second_load}};
  State state = started(scheme, {{0}, {0, 0}, {0, 0}}, 1);
  std::array<double, 6> errors{};
  for (double time : step_ends({0, jump, end}, steps, uneven)) {
    march_step(scheme, state, time, motion.load, motion);
    const Solution& now = state.before[0];
    const Values at = exact(motion, time);
    const int level = scheme.pressures_lag() ? 1 : 0;
    const Solution& settled = state.before[level];
    const Values then = exact(motion, state.times[level]);
    const double gaps[] = {now.wall[0] - at.d, state.wall_velocity[0] - at.v, now.fluid[0] - at.u,
                           now.mesh[0] - at.m, settled.wall[1] - then.d,      settled.fluid[1] - then.u};
    for (int i = 0; i < 6; ++i) errors[i] = std::max(errors[i], std::abs(gaps[i]));
  }
  return errors;
}

struct Named {
  std::string name;
  std::shared_ptr<const TimeIntegrator> scheme;
};

class SecondOrder : public testing::TestWithParam<Named> {};
INSTANTIATE_TEST_SUITE_P(Schemes, SecondOrder,
                         testing::Values(Named{"Midpoint", std::make_shared<ShiftedMidpoint<1>>(0.0)},
                                         Named{"ShiftedMidpoint", std::make_shared<ShiftedMidpoint<1>>(0.5)},
                                         Named{"Bdf2", std::make_shared<Bdf2<1>>()},
                                         Named{"TrBdf2", std::make_shared<TrBdf2<1>>()},
                                         Named{"GeneralisedAlpha0", std::make_shared<GeneralisedAlpha<1>>(0.0)},
                                         Named{"GeneralisedAlpha50", std::make_shared<GeneralisedAlpha<1>>(0.5)}),
                         [](const auto& test) { return test.param.name; });

TEST_P(SecondOrder, FromRestAndThroughAJumpOfTheLoadWithEqualAndUnequalSteps) {
  for (bool uneven : {false, true}) {
    const auto coarse = errors_of(*GetParam().scheme, 240, uneven), fine = errors_of(*GetParam().scheme, 480, uneven);
    for (int i = 0; i < 6; ++i) {
      const double order = std::log2(coarse[i] / fine[i]);
      EXPECT_NEAR(order, 2, 0.1) << quantities[i] << (uneven ? ", unequal steps" : "");
    }
  }
}

TEST(TimeSchemes, EachHasTheOrderThatItNames) {
  for (const std::string& name : time_schemes().names()) {
    const auto scheme = prototype(name);
    const auto coarse = errors_of(*scheme, 240, true), fine = errors_of(*scheme, 480, true);
    for (int i = 0; i < 4; ++i)
      EXPECT_NEAR(std::log2(coarse[i] / fine[i]), scheme->error_terms().order, 0.1) << name << ", " << quantities[i];
  }
}

TEST(TimeSchemes, KeepTheNumbersThatCheckpointsHold) {
  const char* names[] = {"euler", "midpoint", "bdf2", "generalised-alpha", "tr-bdf2"};
  for (int number = 0; number < 5; ++number) EXPECT_EQ(time_schemes().at(names[number]).number, number);
  std::set<int> numbers;
  for (const auto& [name, scheme] : time_schemes().rows()) EXPECT_TRUE(numbers.insert(scheme.number).second) << name;
}

TEST_P(SecondOrder, HasThePeriodThatItNamesInEachStageOfEqualSteps) {
  const TimeIntegrator& scheme = *GetParam().scheme;
  LinearMotion motion;
  motion.load.points = {{0, first_load}};
  constexpr double step = 0.125;
  State state = started(scheme, {{0}, {0, 0}, {0, 0}}, 1);
  for (int i = 1; i <= 4; ++i) march_step(scheme, state, i * step, motion.load, motion);
  const auto look_and_solve = [&](State& now, const StepData& data) {
    EXPECT_NEAR(data.rates.interface.period, scheme.period(step), 1e-14);
    motion(now, data);
  };
  march_step(scheme, state, 5 * step, motion.load, look_and_solve);
}

}  // namespace

}  // namespace fsi::test
