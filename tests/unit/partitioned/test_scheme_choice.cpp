#include <gtest/gtest.h>

#include <cmath>

#include "fem/elements.hpp"
#include "partitioned/interface/membrane.hpp"
#include "partitioned/scheme_choice.hpp"
#include "support/scenes.hpp"

namespace fsi::test {

namespace {

constexpr double most_answers =
    2;  // of the wall in a step of backward Euler up to which it is short (docs/coupling.md)
constexpr double in_short_steps = 1, in_long_steps = 10;

RobinStiffness stiffness_with(const Case& setup) {
  return robin_stiffness(setup, *build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2)));
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

TEST(RobinStiffness, GoesByTheStepOverTheWallsAnswer) {
  Case setup = unnamed_case();
  const double answer = answer_time();
  for (const auto& [answers, factor] : {std::pair{0.1, in_short_steps},
                                        {0.99 * most_answers, in_short_steps},
                                        {1.01 * most_answers, in_long_steps},
                                        {100.0, in_long_steps}}) {
    setup.time->step = answers * answer;
    setup.time->end = 10 * setup.time->step;
    const RobinStiffness stiffness = stiffness_with(setup);
    EXPECT_EQ(stiffness.factor, factor) << answers;
    EXPECT_NE(stiffness.reason.find("as long as the wall takes to answer"), std::string::npos) << stiffness.reason;
  }
}

TEST(RobinStiffness, GoesByThePeriodOfTheTimeScheme) {
  Case setup = unnamed_case();
  setup.time->scheme = "tr-bdf2";  // each stage's period: 1 - 1/sqrt(2) of the step [Bank1985]
  const double longest = most_answers * answer_time() / (1 - 1 / std::sqrt(2.0));
  setup.time->step = 0.99 * longest;
  EXPECT_EQ(stiffness_with(setup).factor, in_short_steps);
  setup.time->step = 1.01 * longest;
  EXPECT_EQ(stiffness_with(setup).factor, in_long_steps);
}

TEST(RobinStiffness, OfAdaptiveStepsGoesByTheLongestThatTheCaseAllows) {
  Case setup = unnamed_case();
  setup.time->adaptive = true;
  setup.time->step = 0;
  EXPECT_EQ(stiffness_with(setup).factor, in_short_steps);
  setup.time->largest_step = 1.99 * most_answers * answer_time();
  EXPECT_EQ(stiffness_with(setup).factor, in_short_steps);
  setup.time->largest_step = 2.01 * most_answers * answer_time();
  EXPECT_EQ(stiffness_with(setup).factor, in_long_steps);
}

TEST(SchemeChoice, KeepsWhatTheCaseNames) {
  Case setup = unnamed_case();
  setup.time->step = 100 * answer_time();
  setup.partitioned.scheme = "robin-neumann-imvj";
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const SchemeChoice choice = chosen_scheme(setup, *scene);
  EXPECT_EQ(choice.name, "robin-neumann-imvj");
  EXPECT_TRUE(choice.named);
}

TEST(SchemeChoice, IsAnInterfaceIterationWhereTheCaseNamesNone) {
  const auto scene = build_scene<P1Tetrahedron>(unnamed_case(), fluid_and_wall_box(2));
  const SchemeChoice choice = chosen_scheme(unnamed_case(), *scene);
  EXPECT_EQ(choice.name, "robin-neumann-inexact");
  EXPECT_FALSE(choice.named);
}

}  // namespace

}  // namespace fsi::test
