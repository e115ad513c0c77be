// Block Newton where both media iterate: one iteration over fluid, wall and datum, against passes of factorised media.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "fem/p1_tetrahedron.hpp"
#include "host/threads.hpp"
#include "linear/choice/general_solvers.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "partitioned/block_newton/block_newton_stepper.hpp"
#include "partitioned/registry.hpp"
#include "support/nodal_arrays.hpp"
#include "support/opening_laws.hpp"
#include "support/random.hpp"
#include "support/scenes.hpp"

namespace fsi::test {

namespace {

[[maybe_unused]] const int one_thread = set_threads(1);

Case block_newton_case(std::int64_t factorised_below) {
  Case setup = coupled_case("neo-hookean");
  setup.partitioned.scheme = "block-newton";
  setup.partitioned.tolerance = 1e-10;
  setup.partitioned.fast.direct_below = factorised_below;
  return setup;
}

struct March {
  std::unique_ptr<Scene<3>> scene;
  std::vector<State> states;
  int passes = 0, krylov = 0;
};

March march(const Case& setup, int steps) {
  March result;
  result.scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  BlockNewtonStepper<3> stepper(*result.scene, loads, setup, coupling_scheme("block-newton"));
  State state = result.scene->at_rest();
  for (int n = 0; n < steps; ++n) {
    const StepReport report = stepper.advance(state);
    result.passes += report.outer_iterations;
    result.krylov += report.coupling->fluid_linear_iterations;
    result.states.push_back(state);
  }
  return result;
}

void expect_same(const Case& iterating, const Case& factorising) {
  const March a = march(iterating, 3), b = march(factorising, 3);
  EXPECT_EQ(a.krylov, a.passes) << "a cycle of each medium a pass, and no solve of one alone";
  EXPECT_EQ(b.krylov, 0);
  EXPECT_EQ(a.scene->profile.phases().count("solve: fluid and wall"), 1u);
  EXPECT_EQ(b.scene->profile.phases().count("solve: fluid and wall"), 0u);
  for (std::size_t n = 0; n < a.states.size(); ++n) {
    const Solution &x = a.states[n].now, &y = b.states[n].now;
    EXPECT_LT(largest(difference(x.fluid, y.fluid)), 1e-7 * largest(y.fluid));
    EXPECT_LT(largest(difference(x.wall, y.wall)), 1e-7 * largest(y.wall));
    EXPECT_LT(largest(difference(x.mesh, y.mesh)), 1e-7 * largest(y.mesh));
  }
}

TEST(BlockLayout, ViewsAreThePartsOfTheWholeInPlace) {
  const BlockLayout layout{2, 3, 1};
  std::vector<float> whole{1, 2, 3, 4, 5, 6};
  ASSERT_EQ(layout.size(), whole.size());
  const BlockView<float> parts = layout.view(whole);
  EXPECT_EQ(std::vector<float>(parts.fluid.begin(), parts.fluid.end()), (std::vector<float>{1, 2}));
  EXPECT_EQ(std::vector<float>(parts.wall.begin(), parts.wall.end()), (std::vector<float>{3, 4, 5}));
  EXPECT_EQ(std::vector<float>(parts.datum.begin(), parts.datum.end()), (std::vector<float>{6}));
  parts.fluid[1] = -2;
  parts.wall[0] = -3;
  parts.datum[0] = -6;
  EXPECT_EQ(whole, (std::vector<float>{1, -2, -3, 4, 5, -6}));
  const std::vector<float>& constant = whole;
  EXPECT_EQ(layout.view(constant).wall[0], -3);
}

TEST(JointIteration, AgreesWithFactorisedMedia) {
  expect_same(block_newton_case(0), block_newton_case(1'000'000));
}

TEST(JointIteration, KnowsHowOpeningsAnswer) {
  Case iterating = block_newton_case(0);
  iterating.inlet.reset();
  iterating.openings["inlet"].law = OpeningLawData{"resistance", {{"resistance", 1.5}, {"distal_pressure", 0.2}}};
  iterating.openings["outlet"].law = windkessel(0.3, 0.05, 2.0, 0.5, 0.8);
  Case factorising = iterating;
  factorising.partitioned.fast.direct_below = 1'000'000;
  expect_same(iterating, factorising);
}

/// The linear system of a first step is solved, with a Robin condition that is `stiffness` times the membrane's.
struct Increment {
  double length;
  int passes;
  std::int64_t stiffenings;
  bool by_each_medium;  ///< solves of one medium alone
};
constexpr std::int64_t iterated = 0, factorised = 1'000'000;  // media, below so many unknowns
Increment increment_with(double stiffness, int most_passes, std::int64_t factorised_below = iterated,
                         double tolerance = 1e-6) {
  Case setup = block_newton_case(factorised_below);
  setup.partitioned.max_iterations = most_passes;
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  State state = scene->at_rest();
  StepData data;
  data.rates = scene->integrator->rates(state, 0.125);
  data.opening_pressures = {1, 0};
  BlockNewtonProblem<3> problem(*scene, setup.partitioned, stiffness);
  problem.work_on(state, data);
  problem.evaluate();
  problem.linearise();
  const double length = problem.solve(tolerance);
  const auto counts = scene->profile.counters();
  const auto found = counts.find("stiffer Robin conditions");
  return {length, problem.cost.passes, found == counts.end() ? 0 : found->second,
          problem.cost.fluid_linear != problem.cost.passes};
}

TEST(JointIteration, TakesAStifferDatumWhereTheFluidAndTheWallDoNotComeToAgree) {
  const Increment usual = increment_with(1, 200);
  EXPECT_EQ(usual.stiffenings, 0);
  const Increment weak = increment_with(1e-3, 34);  // which takes 37 or more; ten times as much takes 30
  EXPECT_EQ(weak.stiffenings, 1);
  EXPECT_FALSE(weak.by_each_medium);
  EXPECT_GT(weak.passes, 34);
  EXPECT_NEAR(weak.length, usual.length, 1e-5 * usual.length);
  const Increment hopeless = increment_with(1e-8, 40);  // twice ten times as much is too little: by solves, as ever
  EXPECT_GE(hopeless.stiffenings, 2);
  EXPECT_TRUE(hopeless.by_each_medium);
}

TEST(BlockNewtonProblem, AStifferDatumAsksForNoSmallerGap) {
  const auto passes = [](double stiffness) { return increment_with(stiffness, 200, factorised, 0.05).passes; };
  EXPECT_LE(passes(1e4), passes(10));
}

/// The cycles' products are those of the Jacobian to single precision, the terms of openings with them.
TEST(JointIteration, CyclesKnowTheJacobian) {
  Case setup = coupled_case("mooney-rivlin");
  setup.openings["outlet"].law = windkessel(0.3, 0.05, 2.0, 0.5, 0.8);
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  FastOptions iterative;
  iterative.direct_below = 0;
  State state = scene->at_rest();
  state.now.fluid = random_field(scene->fluid->nodes().nodes, 4, 0.3, 1e-3, 1);
  StepData data;
  data.rates = scene->integrator->rates(state, 0.125);
  data.opening_pressures = {0.1, 0.2};
  MediumSystem<3> system("fluid", *scene, number_fluid(*scene, true), general_solver_factory<3>("fast", iterative));
  system.work_on(state, data);
  system.evaluate();
  EXPECT_EQ(system.preconditioner(), nullptr) << "before there is a Jacobian";
  system.linearise();
  MediumPreconditioner* medium = system.preconditioner();
  ASSERT_NE(medium, nullptr);
  Random random(3);
  std::vector<float> single(medium->size()), product(single), expected(single), answer(single);
  for (float& value : single) value = static_cast<float>(random());
  std::vector<double> x, whole;
  medium->expand(single, 1, 1e-6, x);
  medium->gather(x, single);  // without padding and held components
  medium->multiply_whole(x, whole);
  medium->gather(whole, expected);
  medium->multiply(single, product);
  float size = 0, apart = 0;
  for (std::size_t i = 0; i < product.size(); ++i) {
    size = std::max(size, std::abs(expected[i]));
    apart = std::max(apart, std::abs(product[i] - expected[i]));
  }
  EXPECT_LT(apart, 1e-5f * size);
  // A cycle answers to the product by about the vector itself, and knows the product with its answer.
  std::vector<float> of_answer(medium->size());
  medium->apply(product, answer, of_answer);
  expected.assign(answer.size(), 0.0F);
  medium->multiply(answer, expected);
  apart = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) apart = std::max(apart, std::abs(of_answer[i] - expected[i]));
  EXPECT_LT(apart, 1e-5f * size);
  double left = 0, all = 0;
  for (std::size_t i = 0; i < single.size(); ++i) {
    left += std::pow(answer[i] - single[i], 2);
    all += std::pow(single[i], 2);
  }
  EXPECT_LT(left, all);
}

}  // namespace

}  // namespace fsi::test
