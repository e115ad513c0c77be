// What is wrong with a network is found before it is solved, and said of the element at fault.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "network/network_checks.hpp"
#include "support/networks.hpp"

namespace fsi::test {

namespace {

const ParameterValues r{{"resistance", 2}}, c{{"compliance", 3}}, l{{"inertance", 1}};
double steady(double) {
  return 1;
}

TEST(NetworkChecks, LetGoodNetworksPass) {
  const std::vector<std::vector<Lumped>> good{
      heart_between("a", "b"),
      {{"resistor", "a", "ground", r}, {"resistor", "b", "ground", r}},
      {{"resistor", "a", "b", r}, {"capacitor", "b", "ground", c}},
      {{"inductor", "a", "m", l}, {"capacitor", "m", "ground", c}, {"inductor", "b", "m", l}},
      {{"diode", "a", "b", r}, {"elastance", "b", "ground", {{"initial_volume", 1}}, steady}},
      {{"pressure", "a", "ground", {}, steady}, {"resistor", "a", "b", r}},
      {{"flow", "ground", "a", {}, steady}, {"capacitor", "a", "b", c}, {"resistor", "b", "ground", r}},
  };
  for (const auto& lumped : good) {
    const auto fault = fault_of(network_of({"a", "b"}, lumped), 1.0);
    EXPECT_FALSE(fault) << fault->element << ": " << fault->problem;
  }
}

TEST(NetworkChecks, NameTheElementAtFault) {
  struct Mistake {
    std::vector<Lumped> lumped;
    std::string element, key, problem;
  };
  const std::vector<Mistake> mistakes{
      {{{"resistor", "a", "a", r}, {"resistor", "a", "ground", r}}, "0 resistor", "between", "both ends"},
      {{{"resistor", "a", "out", r}, {"resistor", "a", "ground", r}},
       "0 resistor",
       "between",
       "nothing else is joined to the node \"out\""},
      {{{"resistor", "a", "ground", r},
        {"resistor", "m", "n", r},
        {"capacitor", "n", "ground", c},
        {"diode", "m", "ground", r}},
       "1 resistor",
       "between",
       "no effect"},
      {{{"resistor", "a", "b", r}}, "0 resistor", "between", "the level of the pressure is not determined"},
      {{{"capacitor", "a", "b", c}, {"resistor", "a", "m", r}, {"inductor", "m", "b", l}},
       "0 capacitor",
       "between",
       "the level of the pressure is not determined"},
      {{{"capacitor", "ground", "a", c}, {"resistor", "a", "ground", r}},
       "0 capacitor",
       "between",
       "begins at the ground"},
      {{{"flow", "a", "ground", {}, steady}, {"resistor", "b", "ground", r}},
       "0 flow",
       "between",
       "the flows into the node \"a\" are all given, by 0 flow: it is over-determined"},
      {{{"pressure", "a", "ground", {}, steady}, {"pressure", "ground", "a", {}, steady}},
       "1 pressure",
       "between",
       "over-determined"},
      {{{"resistor", "a", "m", r}, {"capacitor", "m", "ground", c}, {"capacitor", "m", "ground", c}},
       "2 capacitor",
       "between",
       "closes a loop"},
      {{{"inductor", "a", "m", l}, {"inductor", "m", "n", l}, {"resistor", "n", "ground", r}},
       "0 inductor",
       "between",
       "the flows into the node \"m\" are all given, by 0 inductor, 1 inductor"},
      {{{"inductor", "a", "ground", {{"inertance", 1}, {"initial_flow", 2}}}},
       "0 inductor",
       "initial_flow",
       "belongs to no flow of the fluid"},
      {{{"chamber",
         "a",
         "ground",
         {{"minimum", 1}, {"maximum", 2}, {"period", 100}, {"peak", 50}, {"relaxed", 120}, {"initial_volume", 1}}}},
       "0 chamber",
       "relaxed",
       "behind the period"},
  };
  for (const Mistake& mistake : mistakes) {
    SCOPED_TRACE(mistake.problem);
    std::vector<std::string> openings{"a"};
    for (const Lumped& element : mistake.lumped)
      if (element.from == "b" || element.to == "b") openings = {"a", "b"};
    const auto fault = fault_of(network_of(openings, mistake.lumped), 1.0);
    ASSERT_TRUE(fault);
    // Of elements in a loop, or at a node, any may be named.
    EXPECT_EQ(fault->element.substr(2), mistake.element.substr(2));
    EXPECT_EQ(fault->key, mistake.key);
    EXPECT_NE(fault->problem.find(mistake.problem), std::string::npos) << fault->problem;
    EXPECT_FALSE(fault->remedy.empty());
  }
}

}  // namespace

}  // namespace fsi::test
