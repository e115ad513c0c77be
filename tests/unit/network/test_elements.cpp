// Lumped elements: each equation with its derivatives, what it keeps, and closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "network/chamber.hpp"
#include "network/element_kinds.hpp"
#include "network/valve.hpp"

namespace fsi::test {

namespace {

double given_course(double time) {
  return 0.3 + 0.01 * time;
}

/// Every element of the table, its parameters all different.
std::vector<std::pair<std::string, std::shared_ptr<const NetworkElement>>> all_elements() {
  std::vector<std::pair<std::string, std::shared_ptr<const NetworkElement>>> elements;
  for (const auto& [name, kind] : network_element_kinds().rows()) {
    ParameterValues values;
    for (const auto& p : kind.parameters) {
      const double value = 0.7 + 0.3 * static_cast<double>(values.size());
      values[p.name] = p.bounds.contains(value) ? value : p.standard;
    }
    elements.emplace_back(name, kind.make(values, given_course));
  }
  return elements;
}

TEST(NetworkElements, HaveExactDerivatives) {
  constexpr double h = 1e-6, reference = 0.4;
  for (const auto& [name, element] : all_elements())
    for (const double lag : {0.0, 0.6})
      for (const double drop : {-1.3, 0.2, 0.45, 2.0}) {
        SCOPED_TRACE(name);
        const NetworkMoment at{lag, 12.5};
        const double flow = 0.9;
        const auto value = [&, &element = element](double p, double q) {
          return element->equation(at, reference, p, q).value;
        };
        const auto here = element->equation(at, reference, drop, flow);
        EXPECT_NEAR((value(drop + h, flow) - value(drop - h, flow)) / (2 * h), here.by_drop, 1e-8);
        EXPECT_NEAR((value(drop, flow + h) - value(drop, flow - h)) / (2 * h), here.by_flow, 1e-8);
      }
}

TEST(NetworkElements, KeepWhatTheirRatesSay) {
  constexpr double reference = 0.4, flow = 0.9;
  int keeping = 0;
  for (const auto& [name, element] : all_elements()) {
    SCOPED_TRACE(name);
    if (element->keeps() == NetworkElement::Keeps::nothing) continue;
    ++keeping;
    const NetworkMoment at{0.6, 12.5};
    const double drop = 0.8;
    const double kept = element->kept(at, reference, drop, flow);
    EXPECT_NEAR((kept - reference) / at.lag, element->rate(drop, flow), 1e-14);
    EXPECT_EQ(element->kept({0, 12.5}, reference, drop, flow), reference);
  }
  EXPECT_EQ(keeping, 4) << "capacitor, inductor, chamber and elastance";
}

TEST(NetworkElements, AValveLetsFluidPassOneWayAndTakesEnergy) {
  Valve valve;
  valve.resistance = 0.5;
  valve.quadratic = 0.2;
  valve.leak = 1e-4;
  valve.width = 0.1;
  const auto flow = [&](double drop) { return -valve.equation({}, 0, drop, 0).value; };
  EXPECT_EQ(flow(0), 0);
  const double q = 3;  // open: dp = R q + B q^2
  EXPECT_NEAR(flow(0.5 * q + 0.2 * q * q), q, 1e-14);
  EXPECT_NEAR(flow(-(0.5 * q + 0.2 * q * q)), -1e-4 * q, 1e-14) << "closed it leaks";
  double before = flow(-1);
  for (int i = -999; i <= 1000; ++i) {
    const double drop = 1e-3 * i, now = flow(drop);
    EXPECT_GT(now, before) << drop;
    EXPECT_GE(now * drop, 0) << drop;
    before = now;
  }
}

TEST(NetworkElements, AChamberIsActivatedOnceABeat) {
  Chamber chamber;
  chamber.beat = 800;
  chamber.peak = 300;
  chamber.relaxed = 450;
  chamber.delay = 100;
  for (const double beat : {0.0, 1600.0}) {
    EXPECT_NEAR(chamber.activation(beat + 100), 0, 1e-15);
    EXPECT_NEAR(chamber.activation(beat + 250), 0.5, 1e-13);
    EXPECT_NEAR(chamber.activation(beat + 400), 1, 1e-15);
    EXPECT_NEAR(chamber.activation(beat + 475), 0.5, 1e-13);
    EXPECT_EQ(chamber.activation(beat + 600), 0);
  }
  EXPECT_EQ(chamber.activation(0), 0) << "before the first begin";
  chamber.minimum = 2;
  chamber.maximum = 5;
  EXPECT_NEAR(chamber.elastance(250), 3.5, 1e-12);
}

TEST(NetworkElements, SayWhatContradictsItself) {
  Chamber chamber;
  chamber.peak = 300;
  chamber.relaxed = 250;
  ASSERT_TRUE(chamber.contradiction());
  EXPECT_EQ(chamber.contradiction()->parameter, "relaxed");
  chamber.relaxed = 900;
  EXPECT_EQ(chamber.contradiction()->parameter, "relaxed");
  chamber.relaxed = 450;
  chamber.minimum = 2;
  EXPECT_EQ(chamber.contradiction()->parameter, "maximum");
  chamber.maximum = 2;
  EXPECT_FALSE(chamber.contradiction());
}

}  // namespace

}  // namespace fsi::test
