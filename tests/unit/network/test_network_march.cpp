// Networks marched by every time scheme under given flows, against the same differential equations written by hand and
// solved by the classical method of Runge and Kutta with small steps.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "network/chamber.hpp"
#include "network/valve.hpp"
#include "support/networks.hpp"
#include "time/bdf2.hpp"
#include "time/euler_newmark.hpp"
#include "time/generalised_alpha.hpp"
#include "time/shifted_midpoint.hpp"
#include "time/tr_bdf2.hpp"

namespace fsi::test {

namespace {

using Flows = std::function<std::vector<double>(double time)>;
template <std::size_t m>
using Numbers = std::array<double, m>;

std::vector<std::pair<std::unique_ptr<TimeIntegrator>, double>> schemes_with_orders() {
  std::vector<std::pair<std::unique_ptr<TimeIntegrator>, double>> schemes;
  schemes.emplace_back(std::make_unique<EulerNewmark<2>>(), 1);
  schemes.emplace_back(std::make_unique<ShiftedMidpoint<2>>(0.4), 2);
  schemes.emplace_back(std::make_unique<Bdf2<2>>(), 2);
  schemes.emplace_back(std::make_unique<GeneralisedAlpha<2>>(0.5), 2);
  schemes.emplace_back(std::make_unique<TrBdf2<2>>(), 2);
  return schemes;
}

/// What is kept at the end. \param see  each level
std::vector<double> march(
    const Network& network, const TimeIntegrator& scheme, int steps, double until, const Flows& flows,
    const std::function<void(const std::vector<double>&)>& see = [](const auto&) {}) {
  State state;
  state.now.openings = network.start();
  state.before = {state.now, state.now, state.now};
  scheme.prepare(state);
  state.load_rates = {0};  // of a wall without load
  if (!state.rate.openings.empty())
    state.rate.openings = network.rates(network.at_level(0, state.now.openings.data(), flows(0), flows(0)));
  for (int step = 1; step <= steps; ++step) {
    const int stages = scheme.stages(state);
    for (int stage = 0; stage < stages; ++stage) {
      StepData data;
      data.time = until * step / steps;
      data.rates = scheme.rates(state, data.time - state.time, stage);
      const NetworkMoment at{1 / data.rates.fluid_factor, data.rates.time};
      const double* reference = data.rates.openings_reference.data();
      const NetworkState solved = network.solve(at, reference, flows(data.rates.time));
      EXPECT_TRUE(solved.settled);
      state.now.openings = network.kept(at, reference, solved);
      scheme.accept(state, data);
    }
    see(state.before[0].openings);
  }
  return state.before[0].openings;
}

template <std::size_t m, class Rates>
Numbers<m> by_small_steps(Numbers<m> y, int steps, double until, Rates rates) {
  const double h = until / steps;
  const auto along = [&](const Numbers<m>& slope, double length) {
    Numbers<m> to = y;
    for (std::size_t i = 0; i < m; ++i) to[i] += length * slope[i];
    return to;
  };
  for (int step = 0; step < steps; ++step) {
    const double t = step * h;
    const auto a = rates(t, y), b = rates(t + h / 2, along(a, h / 2)), c = rates(t + h / 2, along(b, h / 2)),
               d = rates(t + h, along(c, h));
    for (std::size_t i = 0; i < m; ++i) y[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
  }
  return y;
}

TEST(NetworkMarch, FollowsItsEquationsAtTheSchemesOrder) {
  Chamber chamber;
  chamber.minimum = 0.3;
  chamber.maximum = 0.8;
  chamber.beat = 8;
  chamber.peak = 4;
  chamber.relaxed = 8;
  const ParameterValues of_chamber{{"minimum", 0.3}, {"maximum", 0.8},         {"period", 8},          {"peak", 4},
                                   {"relaxed", 8},   {"unstressed_volume", 1}, {"initial_volume", 1.5}};
  constexpr double until = 4, compliance = 2, inertance = 0.7, distal = 1.5;
  const auto inflow = [](double t) { return 1.5 * (1 - std::cos(2.5 * t)); };
  const Network network =
      network_of({"in"}, {{"resistor", "in", "a", {{"resistance", 0.4}}},
                          {"capacitor", "a", "ground", {{"compliance", compliance}, {"initial_pressure", 0.2}}},
                          {"inductor", "a", "b", {{"inertance", inertance}, {"initial_flow", 0.1}}},
                          {"chamber", "b", "ground", of_chamber},
                          {"resistor", "b", "ground", {{"resistance", distal}}}});
  // y: volume of the capacitor, flow of the inductor, volume of the chamber.
  const Numbers<3> exact =
      by_small_steps(Numbers<3>{0.2 * compliance, 0.1, 1.5}, 8000, until, [&](double t, const Numbers<3>& y) {
        const double pressure = y[0] / compliance, behind = chamber.elastance(t) * (y[2] - 1);
        return Numbers<3>{inflow(t) - y[1], (pressure - behind) / inertance, y[1] - behind / distal};
      });
  for (const auto& [scheme, order] : schemes_with_orders()) {
    SCOPED_TRACE(order);
    std::vector<double> errors;
    for (const int steps : {160, 320, 640}) {
      const auto end = march(network, *scheme, steps, until, [&](double t) { return std::vector<double>{inflow(t)}; });
      double error = 0;
      for (std::size_t i = 0; i < 3; ++i) error = std::max(error, std::abs(end[i] - exact[i]));
      errors.push_back(error);
    }
    for (int k = 0; k < 2; ++k)
      EXPECT_NEAR(std::log2(errors[k] / errors[k + 1]), order, order == 1 ? 0.1 : 0.25) << errors[k];
    EXPECT_LT(errors[2], order == 1 ? 0.03 : 2e-4);
  }
}

/// A stiff tube stands for the vessel: what enters at "a" leaves at "b" but for what its inertia holds back. Here the flow
/// is that of a resistance between the two nodes, so that the whole loop is lumped.
std::vector<Lumped> closed_loop() {
  std::vector<Lumped> lumped = heart_between("a", "b");
  lumped.push_back({"resistor", "a", "b", {{"resistance", 0.05}}});
  return lumped;
}

TEST(NetworkMarch, AClosedLoopWithAHeartKeepsItsVolume) {
  const Network loop = network_of({"a", "b"}, closed_loop());
  const Flows none = [](double) { return std::vector<double>{0, 0}; };
  const std::vector<double> start = loop.start();
  const double volume = loop.volume(start.data());
  for (const auto& [scheme, order] : schemes_with_orders()) {
    double lowest = 1e9, highest = 0;
    march(loop, *scheme, 360, 900, none, [&](const std::vector<double>& kept) {
      EXPECT_NEAR(loop.volume(kept.data()), volume, 1e-13 * 360 * volume);
      lowest = std::min(lowest, kept[0]);
      highest = std::max(highest, kept[0]);
    });
    EXPECT_GT(highest - lowest, 500) << "the heart beats";
  }
}

TEST(NetworkMarch, ABeatWithValvesIsThatOfItsDifferentialEquation) {
  const Network loop = network_of({"a", "b"}, closed_loop());
  const Flows none = [](double) { return std::vector<double>{0, 0}; };
  Chamber chamber;
  chamber.minimum = 5e-4;
  chamber.maximum = 1e-2;
  chamber.beat = 300;
  chamber.peak = 100;
  chamber.relaxed = 150;
  Valve mitral, aortic;
  mitral.resistance = 0.01;
  aortic.resistance = 0.02;
  aortic.quadratic = 1e-4;
  constexpr double behind = 0.05 + 0.1;  // of what lies behind the aortic valve
  // Its drop is what is left of the pressure: by bisection, since the flow grows with the drop.
  const auto ejected = [&](double from, double to) {
    double low = std::min(0.0, from - to), high = std::max(0.0, from - to);
    const auto flow = [&](double drop) { return -aortic.equation({}, 0, drop, 0).value; };
    for (int k = 0; k < 60; ++k) {
      const double drop = 0.5 * (low + high);
      (drop + behind * flow(drop) > from - to ? high : low) = drop;
    }
    return flow(0.5 * (low + high));
  };
  const Numbers<3> exact = by_small_steps(Numbers<3>{2500, 1000, 3000}, 6000, 300, [&](double t, const Numbers<3>& y) {
    const double ventricle = chamber.elastance(t) * y[0], arteries = y[1] / 100, veins = y[2] / 3000;
    const double out = ejected(ventricle, arteries), in = -mitral.equation({}, 0, veins - ventricle, 0).value;
    const double through = (arteries - veins) / 2;
    return Numbers<3>{in - out, out - through, through - in};
  });
  for (const auto& [scheme, order] : schemes_with_orders()) {
    std::vector<double> errors;
    for (const int steps : {300, 2400}) {
      const auto end = march(loop, *scheme, steps, 300, none);
      double error = 0;
      for (std::size_t i = 0; i < 3; ++i) error = std::max(error, std::abs(end[i] - exact[i]));
      errors.push_back(error);
    }
    EXPECT_LT(errors[0], 0.2) << "of 6500 mm^3";
    EXPECT_LT(errors[1], 0.15 * errors[0]) << "an eighth of the step, and first order at least where valves switch";
  }
}

}  // namespace

}  // namespace fsi::test
