#include <gtest/gtest.h>

#include <cmath>

#include "fem/elements.hpp"
#include "partitioned/interface/membrane.hpp"
#include "partitioned/scheme_choice.hpp"
#include "support/scenes.hpp"

namespace fsi::test {

namespace {

constexpr double most_answers =
    2;  // of the wall in a step of backward Euler for which Robin-Neumann is taken (docs/coupling.md)

SchemeChoice choice_with(const Case& setup) {
  return chosen_scheme(setup, *build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2)));
}

/// Of the box's wall, ms.
double answer_time() {
  return membrane_of(*build_scene<P1Tetrahedron>(coupled_case("neo-hookean"), fluid_and_wall_box(2))).answer_time();
}

Case unnamed_case() {
  Case setup = coupled_case("neo-hookean");
  setup.partitioned.scheme.reset();
  return setup;
}

TEST(SchemeChoice, GoesByTheStepOverTheWallsAnswer) {
  Case setup = unnamed_case();
  const double answer = answer_time();
  for (const auto& [answers, name] : {std::pair{0.1, "robin-neumann-iqn"},
                                      {0.99 * most_answers, "robin-neumann-iqn"},
                                      {1.01 * most_answers, "iqn-ils"},
                                      {100.0, "iqn-ils"}}) {
    setup.time->step = answers * answer;
    setup.time->end = 10 * setup.time->step;
    const SchemeChoice choice = choice_with(setup);
    EXPECT_EQ(choice.name, name) << answers;
    EXPECT_FALSE(choice.named);
    EXPECT_NE(choice.reason.find("as long as the wall takes to answer"), std::string::npos) << choice.reason;
  }
}

TEST(SchemeChoice, GoesByThePeriodOfTheTimeScheme) {
  Case setup = unnamed_case();
  setup.time->scheme = "tr-bdf2";  // each stage's period: 1 - 1/sqrt(2) of the step [Bank1985]
  const double longest = most_answers * answer_time() / (1 - 1 / std::sqrt(2.0));
  setup.time->step = 0.99 * longest;
  EXPECT_EQ(choice_with(setup).name, "robin-neumann-iqn");
  setup.time->step = 1.01 * longest;
  EXPECT_EQ(choice_with(setup).name, "iqn-ils");
}

TEST(SchemeChoice, OfAdaptiveStepsGoesByTheLongestThatTheCaseAllows) {
  Case setup = unnamed_case();
  setup.time->adaptive = true;
  setup.time->step = 0;
  EXPECT_EQ(choice_with(setup).name, "robin-neumann-iqn");
  setup.time->largest_step = 1.99 * most_answers * answer_time();
  EXPECT_EQ(choice_with(setup).name, "robin-neumann-iqn");
  setup.time->largest_step = 2.01 * most_answers * answer_time();
  EXPECT_EQ(choice_with(setup).name, "iqn-ils");
}

TEST(SchemeChoice, KeepsWhatTheCaseNames) {
  Case setup = unnamed_case();
  setup.time->step = 100 * answer_time();
  setup.partitioned.scheme = "robin-neumann-imvj";
  const SchemeChoice choice = choice_with(setup);
  EXPECT_EQ(choice.name, "robin-neumann-imvj");
  EXPECT_TRUE(choice.named);
}

// The other scheme would refuse the case: its fluid has no pressure.
TEST(SchemeChoice, TakesTheOnlyOneWhereAllFlowsAreGiven) {
  Case setup = unnamed_case();
  setup.time->step = 100 * answer_time();
  setup.inlet.reset();
  setup.fluid->outlet = false;
  setup.openings["inlet"].flow_rate = FlowRateData{{{{0.0, 0.1}}}, InflowProfile::plug};
  EXPECT_EQ(choice_with(setup).name, "robin-neumann-iqn");
}

}  // namespace

}  // namespace fsi::test
