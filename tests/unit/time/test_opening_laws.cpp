// Laws of openings, marched by every time scheme under a given flow (docs/theory.md, section 3.5): the Windkessel against
// the exact solution of its equation, every law of the table against its own rates.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "materials/law_parameters.hpp"
#include "openings/lumped_start.hpp"
#include "openings/opening_laws.hpp"
#include "openings/resistance.hpp"
#include "openings/windkessel.hpp"
#include "time/bdf2.hpp"
#include "time/euler_newmark.hpp"
#include "time/generalised_alpha.hpp"
#include "time/shifted_midpoint.hpp"
#include "time/tr_bdf2.hpp"

namespace fsi::test {

namespace {

const Windkessel law = with_parameters<Windkessel>(
    {{"proximal", 0.7}, {"compliance", 2.0}, {"distal", 3.0}, {"distal_pressure", 0.4}, {"initial_pressure", 1.3}});
constexpr double amplitude = 1.5, frequency = 2.5, duration = 3;

double flow(double t) {
  return amplitude * (1 - std::cos(frequency * t));
}

/// p_c under that flow, by variation of constants.
double exact_pressure(double t) {
  const double tau = law.distal * law.compliance, w = frequency * tau, left = std::exp(-t / tau);
  return law.distal_pressure + (law.initial_pressure - law.distal_pressure) * left +
         amplitude * law.distal *
             (1 - left - (std::cos(frequency * t) + w * std::sin(frequency * t) - left) / (1 + w * w));
}

/// Calls see(time, pressure) at balances and see_level(state) at ends of steps.
template <class See, class SeeLevel>
void march(const OpeningLaw& behind, const TimeIntegrator& scheme, int steps,
           const std::function<double(double)>& inflow, double until, bool uneven, See see, SeeLevel see_level) {
  State state;
  state.now.openings = behind.start();
  state.before = {state.now, state.now, state.now};
  scheme.prepare(state);
  state.load_rates = {0};  // of a wall without load
  if (!state.rate.openings.empty()) state.rate.openings = behind.rates(state.now.openings.data(), inflow(0));
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
      const double q = inflow(rates.time), *reference = rates.openings_reference.data();
      state.now.openings = behind.kept(rates.fluid_factor, reference, q);
      see(rates.time, behind.pressure(rates.fluid_factor, reference, q));
      scheme.accept(state, data);
    }
    see_level(state);
  }
}

struct Marched {
  double stored = 0;       ///< p_c at the end
  double error = 0;        ///< largest, of p_c at ends of steps
  double at_balances = 0;  ///< largest, of p less R_p Q at balances
};

Marched march(const TimeIntegrator& scheme, int steps, const std::function<double(double)>& inflow,
              double until = duration, bool uneven = false) {
  Marched marched;
  march(
      law, scheme, steps, inflow, until, uneven,
      [&](double time, double pressure) {
        const double stored = pressure - law.proximal * inflow(time);
        marched.at_balances = std::max(marched.at_balances, std::abs(stored - exact_pressure(time)));
      },
      [&](const State& state) {
        marched.stored = state.before[0].openings[0];
        marched.error = std::max(marched.error, std::abs(marched.stored - exact_pressure(state.time)));
      });
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

/// Every law of the table, its parameters all different.
std::vector<std::pair<std::string, std::shared_ptr<const OpeningLaw>>> all_laws() {
  std::vector<std::pair<std::string, std::shared_ptr<const OpeningLaw>>> laws;
  for (const auto& [name, kind] : opening_laws().rows()) {
    ParameterValues values;
    for (const auto& parameter : kind.parameters)
      values[parameter.name] = 0.7 + 0.3 * static_cast<double>(values.size());
    laws.emplace_back(name, kind.make(values));
  }
  return laws;
}

TEST(OpeningLaws, KeepWhatTheirRatesSay) {
  const double k = 1.7, q = 2;
  for (const auto& [name, behind] : all_laws()) {
    SCOPED_TRACE(name);
    std::vector<double> reference = behind->start();
    for (std::size_t i = 0; i < reference.size(); ++i) reference[i] += 0.2 * static_cast<double>(i + 1);
    const std::vector<double> kept = behind->kept(k, reference.data(), q), rates = behind->rates(kept.data(), q);
    ASSERT_EQ(kept.size(), reference.size());
    ASSERT_EQ(rates.size(), reference.size());
    for (std::size_t i = 0; i < kept.size(); ++i) EXPECT_NEAR(k * (kept[i] - reference[i]), rates[i], 1e-13);
    EXPECT_EQ(behind->time_constant() > 0, !kept.empty());
  }
}

TEST(OpeningLaws, StartFromTheirInitialValues) {
  for (const auto& [name, kind] : opening_laws().rows()) {
    SCOPED_TRACE(name);
    ParameterValues values;
    std::vector<double> initial;
    for (const auto& parameter : kind.parameters) {
      values[parameter.name] = 0.7 + 0.3 * static_cast<double>(values.size());
      if (parameter.name.rfind("initial_", 0) == 0) initial.push_back(values[parameter.name]);
    }
    EXPECT_EQ(kind.make(values)->start(), initial);
  }
}

TEST(OpeningLaws, AnswerTheFlowWithTheirSlope) {
  for (const auto& [name, behind] : all_laws())
    for (const double k : {0.0, 1.7}) {
      SCOPED_TRACE(name);
      const std::vector<double> reference = behind->start();
      const auto pressure = [&, &behind = behind](double q) { return behind->pressure(k, reference.data(), q); };
      EXPECT_NEAR(pressure(2) - pressure(1), behind->slope(k), 1e-13);
      EXPECT_NEAR(pressure(5) - pressure(-3), 8 * behind->slope(k), 1e-13);
    }
}

/// y at the end of the march under flow(), by many small steps of the classical method of Runge and Kutta.
std::vector<double> by_small_steps(const OpeningLaw& behind) {
  constexpr int steps = 3000;
  const double h = duration / steps;
  std::vector<double> y = behind.start();
  const auto along = [&](const std::vector<double>& slope, double length) {
    std::vector<double> to = y;
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += length * slope[i];
    return to;
  };
  for (int step = 0; step < steps; ++step) {
    const double t = step * h, q0 = flow(t), q1 = flow(t + h / 2), q2 = flow(t + h);
    const auto a = behind.rates(y.data(), q0), b = behind.rates(along(a, h / 2).data(), q1),
               c = behind.rates(along(b, h / 2).data(), q1), d = behind.rates(along(c, h).data(), q2);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
  }
  return y;
}

TEST(OpeningLaws, AreMarchedAtTheSchemesOrder) {
  for (const auto& [name, behind] : all_laws()) {
    const std::vector<double> exact_end = by_small_steps(*behind);
    for (const auto& [scheme, order] : schemes_with_orders()) {
      SCOPED_TRACE(name);
      std::vector<double> errors;
      for (const int steps : {160, 320, 640})
        march(
            *behind, *scheme, steps, flow, duration, false, [](double, double) {},
            [&](const State& state) {
              if (state.step < steps) return;
              double error = 0;
              for (std::size_t i = 0; i < exact_end.size(); ++i)
                error = std::max(error, std::abs(state.before[0].openings[i] - exact_end[i]));
              errors.push_back(error);
            });
      for (int k = 0; k < 2 && !exact_end.empty(); ++k)
        EXPECT_NEAR(std::log2(errors[k] / errors[k + 1]), order, order == 1 ? 0.1 : 0.25) << errors[k];
    }
  }
}

constexpr double cycle = 2 * M_PI / frequency;

TEST(LumpedStart, IsThePeriodicSolutionUnderAGivenFlow) {
  const double w = frequency * law.distal * law.compliance;
  const double exact = law.distal_pressure + amplitude * law.distal * (1 - 1 / (1 + w * w));
  std::vector<double> errors;
  for (const int steps : {32, 64})
    errors.push_back(std::abs(
        periodic_start({{std::make_shared<Windkessel>(law)}, nullptr, flow, cycle}, steps).at(0).at(0) - exact));
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.1);
  EXPECT_LT(errors[1], 1e-3 * exact);
}

TEST(LumpedStart, IsThePeriodicSolutionUnderAGivenPressure) {
  // C dp_c/dt = g (e - p_c) with g = 1 / R_p + 1 / R_d and g e = p / R_p + p_d / R_d.
  const double g = 1 / law.proximal + 1 / law.distal, w = frequency * law.compliance / g;
  const double mean = (amplitude / law.proximal + law.distal_pressure / law.distal) / g;
  const double exact = mean - amplitude / law.proximal / g / (1 + w * w);
  const auto found = periodic_start({{std::make_shared<Windkessel>(law)}, flow, nullptr, cycle});
  EXPECT_NEAR(found.at(0).at(0), exact, 1e-5 * exact);
}

TEST(LumpedStart, SharesAFlowByConductance) {
  Windkessel half = law;  // twice the resistances and half the compliance: takes half of what the other takes
  half.proximal *= 2;
  half.distal *= 2;
  half.compliance /= 2;
  const auto together =
      periodic_start({{std::make_shared<Windkessel>(law), std::make_shared<Windkessel>(half)}, nullptr, flow, cycle});
  const auto alone =
      periodic_start({{std::make_shared<Windkessel>(law)}, nullptr, [](double t) { return 2 * flow(t) / 3; }, cycle});
  EXPECT_NEAR(together.at(0).at(0), alone.at(0).at(0), 1e-9);
  EXPECT_NEAR(together.at(1).at(0), alone.at(0).at(0), 1e-9);
}

TEST(LumpedStart, NeedsAWayOut) {
  // Beside an opening without resistance, whatever flows.
  const auto open = std::make_shared<Resistance>();
  open->distal_pressure = 1.5;
  const auto beside = periodic_start({{std::make_shared<Windkessel>(law), open}, nullptr, flow, cycle});
  const auto given = periodic_start({{std::make_shared<Windkessel>(law)}, [](double) { return 1.5; }, nullptr, cycle});
  EXPECT_NEAR(beside.at(0).at(0), given.at(0).at(0), 1e-12);
  EXPECT_THROW(periodic_start({{}, nullptr, flow, cycle}), std::runtime_error);
}

}  // namespace

}  // namespace fsi::test
