// `fast` on Taylor-Hood elements: against the sparse factorisation, iterations on two meshes, what the matrix is taken
// for; scenes of two dimensions.
#include <gtest/gtest.h>

#include <cmath>

#include "fast_solutions.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "fem/p2p1_tetrahedron.hpp"
#include "fem/p2p1_triangle.hpp"
#include "linear/velocity_pressure/fast_solver.hpp"
#include "linear/velocity_pressure/momentum_inverse.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesher/artery_generator.hpp"
#include "support/linear_systems.hpp"

namespace fsi::test {

namespace {

ArteryShape short_tube() {
  ArteryShape shape;
  shape.length = 6;
  return shape;
}

/// Stretched cells, as recommended meshes have them: thin in the layers, long around.
ArteryCells cells(int axial) {
  ArteryCells cells;
  cells.lumen = 2;
  cells.media = 1;
  cells.adventitia = 1;
  cells.around = 8;
  cells.axial = axial;
  return cells;
}

std::unique_ptr<Scene<3>> artery(const Case& setup, int axial) {
  return build_scene<P2P1Tetrahedron>(setup, with_mid_edge_nodes(generate_artery(short_tube(), cells(axial))));
}

/// The case with steps of this length.
Case stepped(double step) {
  auto setup = coupled_case("neo-hookean");
  setup.time->step = step;
  setup.time->end = 10 * step;
  return setup;
}

Case static_wall() {
  auto setup = coupled_case("neo-hookean");
  setup.fluid.reset();
  setup.inlet.reset();
  setup.time.reset();
  setup.static_load = StaticData{};
  setup.load = PressureTable{{{0.0, 0.1}}};
  return setup;
}

/// Iterations to 1e-8 of the system's first Newton equations at rest; the solution is that of the factorisation.
template <int n>
int iterations(Scene<n>& scene, Numbering numbering, double step) {
  System<n> system("scene", scene, std::move(numbering));
  State state = scene.at_rest();
  StepData data;
  if (step > 0) {
    data.rates = scene.integrator->rates(state, step);
    data.opening_pressures = {1.332};
  }
  if (scene.wall) data.interface_load.assign(scene.at_rest().now.wall.size(), 1e-3);
  system.work_on(state, data);
  system.evaluate();
  system.linearise();
  std::vector<double> expected, x;
  DirectLinearSolver<n> direct(system.blocks());
  direct.update();
  direct.solve(system.residual(), 0, expected);
  FastSolver<n> solver(system.blocks(), iterative());
  solver.update();
  const auto report = solver.solve(system.residual(), 1e-8, x);
  EXPECT_TRUE(report.converged);
  EXPECT_FALSE(solver.uses_factorisation());
  EXPECT_LT(relative_difference(x, expected), 1e-5);
  EXPECT_EQ(scene.profile.counters().count("linear solves repeated with a stronger preconditioner"), 0u);
  return report.iterations;
}

TEST(FastSolverTaylorHood, IterationsHardlyGrowWithTheMesh) {
  const auto coarse = artery(stepped(0.125), 6), finer = artery(stepped(0.125), 12);
  const int few = iterations(*coarse, number_scene(*coarse), 0.125),
            more = iterations(*finer, number_scene(*finer), 0.125);
  EXPECT_LE(few, 60);
  EXPECT_LE(more, 1.3 * few);
}

// The pressure's shape derivatives are as large as the wall's stiffness on the interface there. Without them in the
// preconditioned matrix 73 iterations were needed instead of 63, at rest 48.
TEST(FastSolverTaylorHood, ADeformedStateTakesHardlyMoreIterationsThanTheRest) {
  const auto setup = stepped(0.25);
  const auto at_rest = artery(setup, 6);
  const int few = iterations(*at_rest, number_scene(*at_rest), 0.25);
  LinearisedScene<3> deformed(setup, artery(setup, 6), 0);
  FastSolver<3> solver(deformed.blocks(), iterative());
  solver.update();
  std::vector<double> x;
  const auto report = solver.solve(deformed.b(), 1e-8, x);
  EXPECT_TRUE(report.converged);
  EXPECT_FALSE(solver.uses_factorisation());
  EXPECT_LT(relative_difference(x, deformed.solution()), 1e-5);
  EXPECT_LE(report.iterations, 1.4 * few);
}

TEST(FastSolverTaylorHood, SmallAndLargeTimeSteps) {
  const auto small = artery(stepped(0.004), 6), large = artery(stepped(4), 6);
  EXPECT_LE(iterations(*small, number_scene(*small), 0.004), 60);
  EXPECT_LE(iterations(*large, number_scene(*large), 4), 120);
}

TEST(FastSolverTaylorHood, EachMediumAlone) {
  const auto scene = artery(stepped(0.125), 6);
  EXPECT_LE(iterations(*scene, number_fluid(*scene), 0.125), 40);
  EXPECT_LE(iterations(*scene, number_wall(*scene), 0.125), 60);
}

TEST(FastSolverTaylorHood, StaticWall) {
  const auto scene = artery(static_wall(), 6);
  EXPECT_LE(iterations(*scene, number_wall(*scene), 0), 120);
}

/// Stiffness over inertia of the wall, as the preconditioner of the coupled system sees it at rest.
double wall_stiffness(Scene<3>& scene, double step) {
  System<3> system("scene", scene, number_scene(scene));
  State state = scene.at_rest();
  StepData data;
  data.rates = scene.integrator->rates(state, step);
  data.opening_pressures = {1.332};
  system.work_on(state, data);
  system.evaluate();
  system.linearise();
  VelocityPressureLayout<3> layout(system.blocks());
  VelocityPressureMatrix<3> matrix(system.blocks(), layout);
  matrix.fill();
  MomentumInverse<3> momentum(matrix);
  const BlockPreconditionerChoices choices;
  momentum.set_up(choices);
  EXPECT_EQ(momentum.has_wall_levels(), momentum.wall_stiffness() >= choices.coarse_from);
  return momentum.wall_stiffness();
}

// Row sums of a quadratic mass matrix are negative at vertices: taken node by node, any wall would seem stiff.
TEST(FastSolverTaylorHood, AWallOfMuchInertiaIsNotTakenForStiff) {
  const auto setup = stepped(0.125);
  const auto quadratic = artery(setup, 6);
  EXPECT_LT(wall_stiffness(*quadratic, 0.004), 1);
  EXPECT_GT(wall_stiffness(*quadratic, 4), 200);
  ArteryCells halved = cells(12);
  halved.media = halved.adventitia = 2;
  halved.around = 16;
  const auto linear = build_scene<P1Tetrahedron>(setup, generate_artery(short_tube(), halved));
  const double ratio = wall_stiffness(*quadratic, 0.125) / wall_stiffness(*linear, 0.125);
  EXPECT_GT(ratio, 0.4);
  EXPECT_LT(ratio, 2.5);
}

TEST(FastSolverTaylorHood, RescuesAreCounted) {
  const auto scene = artery(stepped(0.125), 4);
  System<3> system("scene", *scene, number_scene(*scene));
  State state = scene->at_rest();
  StepData data;
  data.rates = scene->integrator->rates(state, 0.125);
  data.opening_pressures = {1.332};
  system.work_on(state, data);
  system.evaluate();
  system.linearise();
  FastOptions options = iterative();
  options.max_iterations = 2;
  FastSolver<3> solver(system.blocks(), options);
  solver.update();
  std::vector<double> x;
  EXPECT_TRUE(solver.solve(system.residual(), 1e-9, x).converged);
  EXPECT_TRUE(solver.uses_factorisation());
  EXPECT_EQ(scene->profile.counters().at("linear solves rescued by factorisation"), 1);
}

std::unique_ptr<Scene<2>> artery_section(int axial = 36) {
  auto setup = stepped(0.125);
  setup.geometry = Geometry::axisymmetric;
  ArteryCells few = cells(axial);
  few.media = few.adventitia = 2;
  return build_scene<P2P1AxisymmetricTriangle>(setup, with_mid_edge_nodes(generate_artery_section(short_tube(), few)));
}

TEST(FastSolverTaylorHood, TwoDimensionsByIteration) {
  const auto scene = artery_section();
  EXPECT_LE(iterations(*scene, number_scene(*scene), 0.125), 60);
}

TEST(FastSolverTaylorHood, TwoDimensionsAreFactorisedWhereThreeAreNot) {
  const auto scene = artery_section();
  System<2> system("scene", *scene, number_scene(*scene));
  ASSERT_GT(system.blocks().numbering.size, SolverPolicy::standard_limit(SolvedSystem::jacobian, 3));
  ASSERT_LT(system.blocks().numbering.size, SolverPolicy::standard_limit(SolvedSystem::jacobian, 2));
  EXPECT_TRUE(FastSolver<2>(system.blocks()).uses_factorisation());
  EXPECT_FALSE(FastSolver<2>(system.blocks(), iterative()).uses_factorisation());
  FastOptions options;
  options.direct_below = SolverPolicy::standard_limit(SolvedSystem::jacobian, 3);
  EXPECT_FALSE(FastSolver<2>(system.blocks(), options).uses_factorisation());
}

TEST(FastSolverTaylorHood, FactorsInThePlaneLeaveTheMeshMotionOut) {
  const auto setup = stepped(0.25);
  LinearisedScene<2> deformed(setup, artery_section(300), 0);
  FastSolver<2> solver(deformed.blocks());
  EXPECT_STREQ(solver.preparation(), "factorisation");
  solver.update();
  EXPECT_TRUE(solver.uses_factorisation());
  DirectLinearSolver<2> whole(deformed.blocks());
  whole.update();
  EXPECT_LT(solver.statistics().memory_mib, 0.6 * whole.statistics().memory_mib);
  for (const double tolerance : {1e-2, 1e-5, 1e-9}) {
    std::vector<double> x;
    const auto report = solver.solve(deformed.b(), tolerance, x);
    EXPECT_TRUE(report.converged);
    EXPECT_GE(report.iterations, 1);
    EXPECT_LE(report.iterations, 8) << "corrections for want of shape derivatives";
    EXPECT_LT(relative_difference(x, deformed.solution()), 10 * tolerance);
  }
  EXPECT_EQ(deformed.scene().profile.counters().count("linear solves rescued by factorisation"), 0u);
  EXPECT_EQ(deformed.scene().profile.counters().count("factorisations with the mesh motion"), 0u);
  FastOptions exact;
  exact.exact = true;
  FastSolver<2> exact_solver(deformed.blocks(), exact);
  exact_solver.update();
  std::vector<double> x;
  const auto report = exact_solver.solve(deformed.b(), 1e-2, x);
  EXPECT_LT(report.relative_residual, FastOptions::exact_to);
}

/// More than rounding allows has no solution by parts; factors of the whole are taken for the best there is.
TEST(FastSolverTaylorHood, FactorsInThePlaneThatDoNotGetThereAreReplacedUntilTheNextUpdate) {
  LinearisedScene<2> deformed(stepped(0.25), artery_section(), 0);
  FastSolver<2> solver(deformed.blocks());
  solver.update();
  std::vector<double> x;
  EXPECT_TRUE(solver.try_to_solve(deformed.b(), 1e-30, x).converged);
  EXPECT_LT(relative_difference(x, deformed.solution()), 1e-9);
  const double rescued = solver.statistics().memory_mib;
  solver.update();
  EXPECT_LT(solver.statistics().memory_mib, rescued);
}

/// By the present Jacobian alone, so that what came before does not matter.
TEST(FastSolverTaylorHood, LargerPlaneSystemsAreIteratedWhereTheWallsInertiaPrevails) {
  const auto scene = artery_section(300);
  System<2> system("scene", *scene, number_scene(*scene));
  ASSERT_GT(system.blocks().numbering.size, SolverPolicy::wall_decides_from);
  ASSERT_LT(system.blocks().numbering.size, SolverPolicy::standard_limit(SolvedSystem::jacobian, 2));
  FastSolver<2> solver(system.blocks());
  FastOptions named;
  named.direct_below = SolverPolicy::standard_limit(SolvedSystem::jacobian, 2);
  EXPECT_NE(solver.decides(), "");
  EXPECT_EQ(FastSolver<2>(system.blocks(), named).decides(), "");
  State state = scene->at_rest();
  for (const double step : {1e-3, 1.0, 1e-3}) {
    const bool iterates = step < 0.1;
    StepData data;
    data.rates = scene->integrator->rates(state, step);
    data.opening_pressures = {1.332};
    system.work_on(state, data);
    system.evaluate();
    system.linearise();
    EXPECT_STREQ(solver.preparation(), iterates ? "set-up" : "factorisation");
    solver.update();
    EXPECT_EQ(solver.uses_factorisation(), !iterates) << step << " ms";
    std::vector<double> expected, x;
    DirectLinearSolver<2> direct(system.blocks());
    direct.update();
    direct.solve(system.residual(), 0, expected);
    EXPECT_TRUE(solver.solve(system.residual(), 1e-8, x).converged);
    EXPECT_LT(relative_difference(x, expected), 1e-4);
    FastSolver<2> asked(system.blocks(), named);
    asked.update();
    EXPECT_TRUE(asked.uses_factorisation()) << "a case that names a limit gets it";
  }
}

}  // namespace

}  // namespace fsi::test
