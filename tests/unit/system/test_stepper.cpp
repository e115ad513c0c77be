#include <gtest/gtest.h>

#include "fem/p1_tetrahedron.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "support/nodal_arrays.hpp"
#include "support/scenes.hpp"
#include "system/newton_stepper.hpp"

namespace fsi::test {

namespace {

using Tet = P1Tetrahedron;

[[maybe_unused]] const int single_thread = set_threads(1);

NewtonOptions options() {
  NewtonOptions newton;
  newton.tolerance = 1e-10;
  return newton;
}

/// \param pressure  kPa
Case loaded_wall(double pressure) {
  Case setup = coupled_case("neo-hookean");
  setup.fluid.reset();
  setup.inlet.reset();
  setup.load = PressureTable{{{0, pressure}}};
  return setup;
}

TEST(NewtonStepper, AdvancesTheCoupledSceneAndKeepsItsInterfaceConditions) {
  const auto setup = coupled_case("artery");
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  NewtonStepper<3> stepper(*scene, loads, options(), number_scene(*scene));
  State state = scene->at_rest();
  for (int n = 1; n <= 3; ++n) {
    const State before = state;
    const auto report = stepper.advance(state);
    EXPECT_GT(report.newton_iterations, 0);
    EXPECT_EQ(report.outer_iterations, 1);
    EXPECT_EQ(state.step, n);
    EXPECT_DOUBLE_EQ(state.time, 0.125 * n);
    EXPECT_EQ(state.now.fluid, state.before[0].fluid);
    EXPECT_EQ(before.before[0].wall, state.before[1].wall);
    for (const auto& node : scene->interface)
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(state.now.mesh[3 * node.fluid + k], state.now.wall[4 * node.wall + k]);
        EXPECT_EQ(state.now.fluid[4 * node.fluid + k],
                  (state.now.wall[4 * node.wall + k] - state.before[1].wall[4 * node.wall + k]) / 0.125);
      }
  }
  EXPECT_GT(norm(state.now.wall), 0);
  EXPECT_GT(-scene->fluid->open_boundary("inlet")->outflow(state.now.fluid), 0) << "pressure pushes fluid in";
}

// Uniform mean pressure, no motion left: the extrapolated start of a step is its solution to rounding.
TEST(NewtonStepper, KeepsGoingInASteadyState) {
  auto setup = coupled_case("neo-hookean", 5.0);
  setup.structure.reset();
  setup.fluid->viscosity = 2;  // at rest again within a fraction of a step
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(3));
  const Loads loads(setup);
  NewtonStepper<3> stepper(*scene, loads, options(), number_scene(*scene));
  State state = scene->at_rest();
  for (int n = 0; n < 40; ++n) ASSERT_NO_THROW(stepper.advance(state)) << n;
  EXPECT_LT(norm(difference(state.now.fluid, state.before[1].fluid)), 1e-12 * norm(state.now.fluid));
}

TEST(NewtonStepper, SceneWithoutLoadStaysAtRest) {
  auto setup = coupled_case("mooney-rivlin");
  setup.inlet.reset();
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  NewtonStepper<3> stepper(*scene, loads, options(), number_scene(*scene));
  State state = scene->at_rest();
  for (int n = 0; n < 2; ++n) stepper.advance(state);
  EXPECT_LT(largest(state.now.wall), 1e-14);
  EXPECT_LT(largest(state.now.fluid), 1e-14);
}

TEST(NewtonStepper, AnImpossibleStepThrowsAndLeavesTheFinishedLevels) {
  const auto setup = loaded_wall(1e7);  // a million times the wall's stiffness
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  NewtonStepper<3> stepper(*scene, loads, options(), number_scene(*scene));
  State state = scene->at_rest();
  const State start = state;
  EXPECT_THROW(stepper.advance(state), ConvergenceError);
  EXPECT_FALSE(stepper.system().linearised()) << "a Jacobian of a place far away";
  EXPECT_EQ(state.step, 0);
  EXPECT_EQ(state.before[0].wall, start.before[0].wall);
}

// A load that Newton's method follows from the start in many iterations, and through shorter steps in few each.
TEST(NewtonStepper, WalksToAStepThatItDoesNotReachAtOnce) {
  const auto setup = loaded_wall(20);
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  const auto stepper_of = [&](int most_iterations) {
    NewtonOptions newton = options();
    newton.mode = NewtonMode::full;
    newton.max_iterations = most_iterations;
    return NewtonStepper<3>(*scene, loads, newton, number_scene(*scene));
  };
  State at_once = scene->at_rest(), walked = at_once;
  auto patient = stepper_of(30);
  const int iterations = patient.advance(at_once).newton_iterations;
  auto hasty = stepper_of(iterations - 1);
  EXPECT_THROW(hasty.advance(walked), ConvergenceError);
  hasty.persist(true);
  const StepReport report = hasty.advance(walked);
  EXPECT_EQ(walked.step, 1);
  EXPECT_GT(report.newton_iterations, iterations);
  EXPECT_LT(norm(difference(walked.now.wall, at_once.now.wall)), 1e-9 * norm(at_once.now.wall));
}

TEST(NewtonStepper, SaysHowLongAStepHasASolution) {
  const auto setup = loaded_wall(1e4);
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  NewtonStepper<3> stepper(*scene, loads, options(), number_scene(*scene));
  stepper.persist(true);
  State state = scene->at_rest();
  try {
    stepper.advance(state);
    FAIL() << "no such step";
  } catch (const ConvergenceError& failure) {
    EXPECT_NE(std::string(failure.what()).find("ms has a solution, none of"), std::string::npos) << failure.what();
  }
  EXPECT_EQ(state.step, 0);
}

TEST(NewtonStepper, RecallsItsJacobianBitForBit) {
  const auto setup = coupled_case("artery");
  const auto mesh = fluid_and_wall_box(2);
  const auto scene = build_scene<P1Tetrahedron>(setup, mesh);
  const Loads loads(setup);
  NewtonStepper<3> stepper(*scene, loads, options(), number_scene(*scene));
  State state = scene->at_rest();
  for (int n = 0; n < 3; ++n) stepper.advance(state);

  const auto fresh = build_scene<P1Tetrahedron>(setup, mesh);
  NewtonStepper<3> restarted(*fresh, loads, options(), number_scene(*fresh));
  WrittenArchive archive = archive_of(stepper);
  restarted.keep(archive.turn());
  State copy = state;
  for (int n = 0; n < 2; ++n) {
    stepper.advance(state);
    restarted.advance(copy);
    EXPECT_EQ(state.now.wall, copy.now.wall);
    EXPECT_EQ(state.now.fluid, copy.now.fluid);
    EXPECT_EQ(state.now.mesh, copy.now.mesh);
  }
}

}  // namespace

}  // namespace fsi::test
