#include <gtest/gtest.h>

#include "base/threads.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "fem/p2p1_triangle.hpp"
#include "mesh/artery_generator.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "partitioned/coupling_stepper.hpp"
#include "support/nodal_arrays.hpp"
#include "support/scenes.hpp"
#include "system/newton_stepper.hpp"

namespace fsi::test {

namespace {

using Tet = P1Tetrahedron;

[[maybe_unused]] const int single_thread = set_threads(1);

Case partitioned_case(const std::string& scheme, double tolerance, const std::string& material = "neo-hookean") {
  Case setup = coupled_case(material);
  setup.partitioned.scheme = scheme;
  setup.partitioned.tolerance = tolerance;
  setup.partitioned.max_iterations = 2000;
  return setup;
}

/// Marches a box of fluid and wall; returns the states after each step.
template <class MakeStepper>
std::vector<State> march(const Case& setup, int steps, MakeStepper make) {
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  const auto stepper = make(*scene, loads);
  std::vector<State> states;
  State state = scene->at_rest();
  for (int n = 0; n < steps; ++n) {
    const StepReport report = stepper->advance(state);
    EXPECT_EQ(report.coupling.has_value(), stepper->reports_coupling());
    states.push_back(state);
  }
  return states;
}

std::vector<State> march_partitioned(const Case& setup, int steps) {
  return march(setup, steps, [&](Scene<3>& scene, const Loads& loads) {
    return std::make_unique<CouplingStepper<3>>(scene, loads, setup);
  });
}

class EachScheme : public testing::TestWithParam<std::string> {};

/// For both ways in which the layers' pressures can meet.
TEST_P(EachScheme, ConvergesToTheMonolithicSolution) {
  for (const auto& [material, layer_pressure] :
       {std::pair{"neo-hookean", LayerPressure::continuous}, std::pair{"artery", LayerPressure::separate}}) {
    Case setup = partitioned_case(GetParam(), 1e-10, material);
    setup.structure->layer_pressure = layer_pressure;
    NewtonOptions newton;
    newton.tolerance = 1e-12;
    const auto whole = march(setup, 3, [&](Scene<3>& scene, const Loads& loads) {
      return std::make_unique<NewtonStepper<3>>(scene, loads, newton, number_scene(scene));
    });
    const auto parts = march_partitioned(setup, 3);
    for (std::size_t n = 0; n < 3; ++n) {
      const Solution &a = parts[n].before[0], &b = whole[n].before[0];
      EXPECT_LT(norm(difference(a.wall, b.wall)), 1e-7 * norm(b.wall)) << material << ", step " << n + 1;
      EXPECT_LT(norm(difference(a.fluid, b.fluid)), 1e-7 * norm(b.fluid)) << material << ", step " << n + 1;
      EXPECT_LT(norm(difference(a.mesh, b.mesh)), 1e-7 * norm(b.mesh)) << material << ", step " << n + 1;
    }
  }
}

// Taylor-Hood elements of a body of revolution, each layer with its pressure: displacements stay one at the copies of a
// node.
TEST_P(EachScheme, ConvergesToTheMonolithicSolutionOfAnotherElement) {
  Case setup = partitioned_case(GetParam(), 1e-9);
  setup.structure->layer_pressure = LayerPressure::separate;
  ArteryShape shape;
  shape.length = 3;
  ArteryCells cells;
  cells.lumen = 2;
  cells.media = cells.adventitia = 1;
  cells.axial = 4;
  const auto mesh = with_mid_edge_nodes(generate_artery_section(shape, cells));
  const auto scene = build_scene<P2P1AxisymmetricTriangle>(setup, mesh),
             other = build_scene<P2P1AxisymmetricTriangle>(setup, mesh);
  ASSERT_TRUE(scene->wall->nodes().has_copies());
  const Loads loads(setup);
  NewtonOptions newton;
  newton.tolerance = 1e-11;
  NewtonStepper<2> whole(*scene, loads, newton, number_scene(*scene));
  CouplingStepper<2> parts(*other, loads, setup);
  State a = scene->at_rest(), b = other->at_rest();
  for (int n = 0; n < 2; ++n) {
    whole.advance(a);
    parts.advance(b);
    EXPECT_LT(norm(difference(a.now.wall, b.now.wall)), 1e-6 * norm(a.now.wall)) << "step " << n + 1;
    EXPECT_LT(norm(difference(a.now.fluid, b.now.fluid)), 1e-6 * norm(a.now.fluid)) << "step " << n + 1;
    double jump = 0;
    for (const State* state : {&a, &b})
      for (int node = 0; node < scene->wall->node_count(); ++node) {
        const int original = scene->wall->nodes().original_of(node);
        for (int k = 0; k < 2; ++k) {
          EXPECT_EQ(state->now.wall[3 * node + k], state->now.wall[3 * original + k]);
          EXPECT_EQ(state->wall_velocity[2 * node + k], state->wall_velocity[2 * original + k]);
          EXPECT_EQ(state->wall_acceleration[2 * node + k], state->wall_acceleration[2 * original + k]);
        }
        jump = std::max(jump, std::abs(state->now.wall[3 * node + 2] - state->now.wall[3 * original + 2]));
      }
    EXPECT_GT(jump, 0.01) << "kPa";
  }
}

TEST_P(EachScheme, GoesOnBitForBitFromItsMemory) {
  const Case setup = partitioned_case(GetParam(), 1e-5);
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2)),
             scene_again = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  CouplingStepper<3> stepper(*scene, loads, setup), again(*scene_again, loads, setup);
  State state = scene->at_rest();
  for (int n = 0; n < 3; ++n) stepper.advance(state);
  State copy = state;
  again.recall(stepper.memory());
  for (int n = 0; n < 2; ++n) {
    const auto first = stepper.advance(state), second = again.advance(copy);
    EXPECT_EQ(first.outer_iterations, second.outer_iterations);
    EXPECT_EQ(first.newton_iterations, second.newton_iterations);
  }
  EXPECT_EQ(state.now.wall, copy.now.wall);
  EXPECT_EQ(state.now.fluid, copy.now.fluid);
  EXPECT_EQ(state.now.mesh, copy.now.mesh);
}

TEST_P(EachScheme, LeavesASceneWithoutLoadAtRest) {
  Case setup = partitioned_case(GetParam(), 1e-8);
  setup.inlet.reset();
  for (const State& state : march_partitioned(setup, 2)) {
    EXPECT_EQ(largest(state.now.wall), 0);
    EXPECT_EQ(largest(state.now.fluid), 0);
  }
}

TEST_P(EachScheme, ReportsWhatItDid) {
  const Case setup = partitioned_case(GetParam(), 1e-6);
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  CouplingStepper<3> stepper(*scene, loads, setup);
  State state = scene->at_rest();
  const StepReport report = stepper.advance(state);
  ASSERT_TRUE(report.coupling);
  const CouplingReport& coupling = *report.coupling;
  EXPECT_LE(coupling.displacement_residual, 1e-6);
  EXPECT_GT(coupling.displacement_gap, 0);
  EXPECT_GT(coupling.force_residual, 0);
  EXPECT_LT(coupling.force_residual, 1e-4);
  EXPECT_EQ(coupling.failed_passes, 0);
  EXPECT_EQ(report.newton_iterations, coupling.fluid_newton_iterations + coupling.wall_newton_iterations);
  EXPECT_GT(coupling.fluid_seconds, 0);
  EXPECT_GT(coupling.wall_seconds, 0);
  const bool mesh_is_the_fluids = std::string(GetParam()).rfind("robin", 0) == 0;  // solved with it, in its seconds
  EXPECT_EQ(coupling.mesh_seconds > 0, !mesh_is_the_fluids);
}

INSTANTIATE_TEST_SUITE_P(CouplingStepper, EachScheme,
                         testing::Values("constant", "aitken", "iqn-ils", "iqn-imvj", "newton-krylov", "robin-neumann",
                                         "robin-neumann-iqn", "robin-neumann-imvj"),
                         [](const auto& scheme) {
                           std::string name = scheme.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(CouplingStepper, ExplicitTakesOnePass) {
  const Case setup = partitioned_case("explicit", 1e-6);
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  CouplingStepper<3> stepper(*scene, loads, setup);
  State state = scene->at_rest();
  const StepReport report = stepper.advance(state);
  EXPECT_EQ(report.outer_iterations, 1);
  EXPECT_GT(report.coupling->displacement_residual, 1e-6) << "reported as it is";
}

TEST(CouplingStepper, ExplicitWithoutExtrapolationIsRefused) {
  Case setup = partitioned_case("explicit", 1e-6);
  setup.time->predictor = 0;
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  EXPECT_THROW(CouplingStepper<3>(*scene, loads, setup), InputError);
}

TEST(CouplingStepper, ADivergingIterationEndsEarly) {
  Case setup = partitioned_case("constant", 1e-6);
  setup.partitioned.relaxation = 3;             // more than 2 diverges without any added mass
  setup.inlet = PressureTable{{{0.0, 1e-12}}};  // so small that no element is inverted on the way
  setup.partitioned.absolute_tolerance = 0;
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  CouplingStepper<3> stepper(*scene, loads, setup);
  State state = scene->at_rest();
  try {
    stepper.advance(state);
    FAIL();
  } catch (const ConvergenceError& error) {
    EXPECT_NE(std::string(error.what()).find("diverges"), std::string::npos) << error.what();
  }
  EXPECT_LT(stepper.report().outer_iterations, 200);
  EXPECT_EQ(state.step, 0);
}

TEST(CouplingStepper, ObeysTheForceTolerance) {
  Case setup = partitioned_case("iqn-ils", 1e-2);
  setup.partitioned.force_tolerance = 1e-8;
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  CouplingStepper<3> stepper(*scene, loads, setup);
  State state = scene->at_rest();
  const StepReport report = stepper.advance(state);
  EXPECT_LE(report.coupling->force_residual, 1e-8);
}

TEST(CouplingStepper, AbsoluteToleranceIsEnough) {
  Case setup = partitioned_case("iqn-ils", 1e-12);
  setup.partitioned.absolute_tolerance = 1e-4;
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  CouplingStepper<3> stepper(*scene, loads, setup);
  State state = scene->at_rest();
  const StepReport report = stepper.advance(state);
  EXPECT_LE(report.coupling->displacement_gap, 1e-4);
  EXPECT_GT(report.coupling->displacement_residual, 1e-12);
}

TEST(CouplingStepper, APassWithoutAnswerIsTriedAgainCloser) {
  // A strong push and far too large a first relaxation: the first correction turns elements inside out.
  Case setup = partitioned_case("iqn-ils", 1e-6);
  setup.partitioned.relaxation = 1.5;
  setup.inlet = PressureTable{{{0.0, 40.0}}};
  setup.stabilisation = Stabilisation::paper;  // softer: the default bears this push
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  CouplingStepper<3> stepper(*scene, loads, setup);
  State state = scene->at_rest();
  const StepReport report = stepper.advance(state);
  EXPECT_GT(report.coupling->failed_passes, 0);
  EXPECT_LE(report.coupling->displacement_residual, 1e-6);
}

TEST(CouplingStepper, SaysWhenItDoesNotConvergeAndLeavesTheFinishedLevels) {
  Case setup = partitioned_case("iqn-ils", 1e-10);
  setup.partitioned.max_iterations = 2;
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  CouplingStepper<3> stepper(*scene, loads, setup);
  State state = scene->at_rest();
  try {
    stepper.advance(state);
    FAIL();
  } catch (const ConvergenceError& error) {
    EXPECT_NE(std::string(error.what()).find("partitioned.max_iterations"), std::string::npos) << error.what();
  }
  EXPECT_EQ(state.step, 0);
  EXPECT_EQ(largest(state.before[0].wall), 0);
  EXPECT_EQ(stepper.report().outer_iterations, 2);
}

}  // namespace

}  // namespace fsi::test
