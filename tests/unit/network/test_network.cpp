// Networks: pressures by flows in closed form, exact derivatives, finished levels, and what a closed one conserves.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/networks.hpp"

namespace fsi::test {

namespace {

TEST(Network, AStarOfResistancesAnswersEveryFlow) {
  const Network star = network_of({"a", "b"},
                                  {{"resistor", "a", "m", {{"resistance", 1}}},
                                   {"resistor", "m", "b", {{"resistance", 2}}},
                                   {"resistor", "m", "ground", {{"resistance", 3}}}},
                                  0.7);
  const NetworkMoment at{0.5, 0};
  const NetworkState state = star.solve(at, nullptr, {4, -1});
  ASSERT_TRUE(state.settled);
  EXPECT_NEAR(state.pressures[2], 0.7 + 3 * 3, 1e-13);
  EXPECT_NEAR(state.pressures[0], 9.7 + 4, 1e-13);
  EXPECT_NEAR(state.pressures[1], 9.7 - 2, 1e-13);
  EXPECT_NEAR(state.flows[1], 1, 1e-13) << "positive from the first end to the second";
  const std::vector<double> slopes = star.slopes(at, nullptr, state), exact{4, 3, 3, 5};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(slopes[i], exact[i], 1e-13);
  EXPECT_EQ(star.loops(), 0) << "the vessel closes them";
  EXPECT_FALSE(star.is_closed());
}

/// All kinds, some nonlinear, behind three openings.
Network many_elements() {
  std::vector<Lumped> lumped = heart_between("a", "b");
  lumped.push_back({"inductor", "c", "arteries", {{"inertance", 0.4}, {"initial_flow", 0}}});
  lumped.push_back({"pressure", "s", "ground", {}, [](double t) { return 1 + 0.1 * t; }});
  lumped.push_back({"resistor", "s", "b", {{"resistance", 5}}});
  lumped.push_back({"flow", "veins", "arteries", {}, [](double t) { return 0.1 * t; }});
  lumped.push_back({"elastance", "b", "ground", {{"initial_volume", 3}}, [](double t) { return 0.2 + 0.01 * t; }});
  return network_of({"a", "b", "c"}, lumped);
}

TEST(Network, DerivativesAreExact) {
  const Network network = many_elements();
  std::vector<double> reference = network.start();
  for (const double time : {30.0, 110.0, 200.0})
    for (const double q : {-0.3, 0.2, 6.0}) {
      const NetworkMoment at{2.0, time};
      const std::vector<double> flows{-q, 0.5 * q, 0.1};
      const NetworkState here = network.solve(at, reference.data(), flows);
      ASSERT_TRUE(here.settled);
      const std::vector<double> slopes = network.slopes(at, reference.data(), here);
      std::vector<double> errors;
      for (const double h : {4e-3, 2e-3}) {
        double error = 0;
        for (std::size_t j = 0; j < 3; ++j) {
          std::vector<double> up = flows, down = flows;
          up[j] += h;
          down[j] -= h;
          const auto above = network.solve(at, reference.data(), up), below = network.solve(at, reference.data(), down);
          for (std::size_t i = 0; i < 3; ++i) {
            const double slope = (above.pressures[i] - below.pressures[i]) / (2 * h);
            error = std::max(error, std::abs(slope - slopes[i * 3 + j]) / (1 + std::abs(slopes[i * 3 + j])));
          }
        }
        errors.push_back(error);
      }
      EXPECT_LT(errors[1], 1e-4) << time << " " << q;
      EXPECT_LT(errors[1], 0.3 * errors[0] + 1e-9) << "differences of second order";
    }
}

TEST(Network, FulfilsTheLawsOfKirchhoff) {
  const Network network = many_elements();
  const std::vector<double> reference = network.start(), flows{1.5, -0.4, 0.2};
  const NetworkState state = network.solve({2.0, 30.0}, reference.data(), flows);
  std::vector<double> sums(network.nodes().size(), 0.0);
  for (std::size_t i = 0; i < flows.size(); ++i) sums[i] = flows[i];
  for (std::size_t e = 0; e < network.elements().size(); ++e) {
    const auto& element = network.elements()[e];
    if (element.from != Network::ground) sums[element.from] -= state.flows[e];
    if (element.to != Network::ground) sums[element.to] += state.flows[e];
  }
  for (const double sum : sums) EXPECT_NEAR(sum, 0, 1e-11);
}

TEST(Network, OfAFinishedLevelFollowsFromWhatIsKept) {
  const Network network =
      network_of({"a"}, {{"inductor", "a", "m", {{"inertance", 2}}},
                         {"capacitor", "m", "ground", {{"compliance", 4}, {"unstressed_volume", 1}}},
                         {"resistor", "m", "ground", {{"resistance", 3}}}});
  const std::vector<double> kept{0.5, 9};  // flow, volume
  const NetworkState level = network.at_level(0, kept.data(), {0.5}, {7});
  EXPECT_EQ(level.pressures[0], 7) << "the fluid's: nothing kept tells it";
  EXPECT_NEAR(level.pressures[1], 2, 1e-14);
  EXPECT_NEAR(level.flows[1], 0.5 - 2.0 / 3, 1e-14);
  const std::vector<double> rates = network.rates(level);
  EXPECT_NEAR(rates[0], (7.0 - 2) / 2, 1e-14);
  EXPECT_NEAR(rates[1], 0.5 - 2.0 / 3, 1e-14);
}

TEST(Network, SaysWhatItIs) {
  const Network heart = network_of({"a", "b"}, heart_between("a", "b"));
  EXPECT_TRUE(heart.is_closed());
  EXPECT_EQ(heart.loops(), 2) << "with the vessel between its openings there is one more";
  const std::vector<double> start = heart.start();
  EXPECT_EQ(heart.volume(start.data()), 2500 + 1000 + 3000);
  EXPECT_FALSE(many_elements().is_closed());
}

}  // namespace

}  // namespace fsi::test
