// The Windkessel behind an opening, marched by every time scheme under a given flow (docs/theory.md, section 3.5),
// against the exact solution of its equation.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "fluid/outflow_law.hpp"
#include "time/bdf2.hpp"
#include "time/euler_newmark.hpp"
#include "time/generalised_alpha.hpp"
#include "time/shifted_midpoint.hpp"
#include "time/tr_bdf2.hpp"

namespace fsi::test {

namespace {

const OutflowLaw law{0.7, 2.0, 3.0, 0.4, 1.3};  // R_p, C, R_d, p_d, p_c at the start
constexpr double amplitude = 1.5, frequency = 2.5, duration = 3;

double flow(double t) {
  return amplitude * (1 - std::cos(frequency * t));
}

/// p_c under that flow, by variation of constants.
double exact(double t) {
  const double tau = law.distal * law.compliance, w = frequency * tau, left = std::exp(-t / tau);
  return law.distal_pressure + (law.initial_pressure - law.distal_pressure) * left +
         amplitude * law.distal *
             (1 - left - (std::cos(frequency * t) + w * std::sin(frequency * t) - left) / (1 + w * w));
}

struct Marched {
  double stored = 0;       ///< p_c at the end
  double error = 0;        ///< largest, of p_c at ends of steps
  double at_balances = 0;  ///< largest, of p less R_p Q at balances
};

Marched march(const TimeIntegrator& scheme, int steps, const std::function<double(double)>& inflow,
              double until = duration, bool uneven = false) {
  State state;
  state.now.windkessel = {law.initial_pressure};
  state.before = {state.now, state.now, state.now};
  scheme.prepare(state);
  state.load_rates = {0};  // of a wall without load
  if (!state.rate.windkessel.empty()) state.rate.windkessel[0] = law.rate(law.initial_pressure, inflow(0));
  Marched marched;
  for (int step = 1; step <= steps; ++step) {
    const double x = static_cast<double>(step) / steps;
    const double to = until * (uneven ? x + 0.05 * std::sin(4 * std::acos(0.0) * x) : x);
    const double length = to - state.time;
    const int stages = scheme.stages(state);
    for (int stage = 0; stage < stages; ++stage) {
      StepData data;
      data.time = to;
      data.rates = scheme.rates(state, length, stage);
      const StepRates& rates = data.rates;
      const double q = inflow(rates.time), reference = rates.windkessel_reference.at(0);
      state.now.windkessel[0] = law.stored_pressure(rates.fluid_factor, reference, q);
      const double pressure = law.pressure(rates.fluid_factor, reference, q) - law.proximal * q;
      marched.at_balances = std::max(marched.at_balances, std::abs(pressure - exact(rates.time)));
      scheme.accept(state, data);
    }
    marched.error = std::max(marched.error, std::abs(state.before[0].windkessel[0] - exact(state.time)));
  }
  marched.stored = state.before[0].windkessel[0];
  return marched;
}

std::vector<std::pair<std::unique_ptr<TimeIntegrator>, double>> schemes_with_orders() {
  std::vector<std::pair<std::unique_ptr<TimeIntegrator>, double>> schemes;
  schemes.emplace_back(std::make_unique<EulerNewmark<2>>(), 1);
  schemes.emplace_back(std::make_unique<ShiftedMidpoint<2>>(0.4), 2);
  schemes.emplace_back(std::make_unique<Bdf2<2>>(), 2);
  schemes.emplace_back(std::make_unique<GeneralisedAlpha<2>>(0.5), 2);
  schemes.emplace_back(std::make_unique<TrBdf2<2>>(), 2);
  return schemes;
}

TEST(Windkessel, FollowsItsEquationAtTheSchemesOrder) {
  int number = 0;
  for (const auto& [scheme, order] : schemes_with_orders())
    for (const bool uneven : {false, true}) {
      SCOPED_TRACE(number++);
      std::vector<double> stored, pressure;
      for (const int steps : {80, 160, 320}) {
        const Marched marched = march(*scheme, steps, flow, duration, uneven);
        stored.push_back(marched.error);
        pressure.push_back(marched.at_balances);
      }
      EXPECT_LT(stored[2], order == 1 ? 0.02 : 1e-3);
      for (int k = 0; k < 2; ++k) {
        EXPECT_NEAR(std::log2(stored[k] / stored[k + 1]), order, order == 1 ? 0.1 : 0.25);
        EXPECT_GT(std::log2(pressure[k] / pressure[k + 1]), order - 0.3);
      }
    }
}

TEST(Windkessel, ForgetsItsStartWithAnyStep) {
  const auto constant = [](double) { return 0.2; };
  const double rest = law.distal_pressure + 0.2 * law.distal;
  for (const auto& [scheme, order] : schemes_with_orders()) {
    const double stored = march(*scheme, 200, constant, 1e5).stored;  // steps of 83 times its own time
    EXPECT_NEAR(stored, rest, 0.05 * std::abs(rest - law.initial_pressure)) << order;
  }
}

TEST(Windkessel, AnswersTheFlowWithItsSlope) {
  const double k = 1.7, reference = 0.9, step = 1e-3;
  const double difference = law.pressure(k, reference, 2 + step) - law.pressure(k, reference, 2 - step);
  EXPECT_NEAR(difference / (2 * step), law.slope(k), 1e-12);
  const double stored = law.stored_pressure(k, reference, 2);
  EXPECT_NEAR(k * (stored - reference), law.rate(stored, 2), 1e-14) << "the equation at the balance";
  const OutflowLaw resistance{0.7, 0, 0, 0.4, 0};
  EXPECT_DOUBLE_EQ(resistance.pressure(k, 0, 2), 0.4 + 0.7 * 2);
  EXPECT_DOUBLE_EQ(resistance.slope(k), 0.7);
}

}  // namespace

}  // namespace fsi::test
