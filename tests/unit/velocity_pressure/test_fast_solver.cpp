// `fast` against the sparse factorisation: the coupled system at a deformed state, its sub-problems, statics, and what
// happens when the iteration cannot converge.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "case/choices.hpp"
#include "fast_solutions.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "fem/p1_triangle.hpp"
#include "fem/p2p1_triangle.hpp"
#include "host/threads.hpp"
#include "linear/interface/jacobian_product.hpp"
#include "linear/velocity_pressure/fast_solver.hpp"
#include "linear/velocity_pressure/flow_preconditioner.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesher/artery_generator.hpp"
#include "support/linear_systems.hpp"
#include "support/partly_fixed.hpp"
#include "support/random.hpp"

namespace fsi::test {

namespace {

using Tet = P1Tetrahedron;

/// A short, coarse artery of fibred wall in its third step: every block of the Jacobian is there.
LinearisedScene<3>& artery() {
  static LinearisedScene<3> scene = [] {
    auto setup = coupled_case("artery");
    ArteryOptions options;
    options.length = 6;
    return LinearisedScene<3>(setup, build_scene<P1Tetrahedron>(setup, generate_artery(options)), 2);
  }();
  return scene;
}

TEST(FastSolver, SolvesTheCoupledSystemAtADeformedState) {
  FastSolver<3> solver(artery().blocks(), iterative());
  EXPECT_FALSE(solver.ready());
  solver.update();
  EXPECT_TRUE(solver.ready());
  std::vector<double> x;
  const auto report = solver.solve(artery().b(), 1e-10, x);
  EXPECT_TRUE(report.converged);
  EXPECT_FALSE(solver.uses_factorisation());
  EXPECT_LE(report.relative_residual, 1e-10);
  EXPECT_LE(report.iterations, 30);
  EXPECT_LT(relative_difference(x, artery().solution()), 1e-7);
}

/// Fine meshes and large steps: what the outer iteration leaves out is no longer small. Each iteration on its own would
/// then leave most of the residual, or more than there was.
TEST(FastSolver, KeepsDirectionsWhereShapeDerivativesAreLarge) {
  auto blocks = artery().blocks();
  auto larger = *blocks.shape_derivatives;
  for (double& value : larger.values) value *= 40;
  blocks.shape_derivatives = &larger;
  DirectLinearSolver<3> direct(blocks);
  direct.update();
  std::vector<double> expected, x;
  direct.solve(artery().b(), 0, expected);
  FastSolver<3> solver(blocks, iterative());
  solver.update();
  const auto report = solver.solve(artery().b(), 1e-10, x);
  EXPECT_TRUE(report.converged) << report.failure;
  EXPECT_FALSE(solver.uses_factorisation());
  EXPECT_LE(report.iterations, 80);
  EXPECT_LT(relative_difference(x, expected), 1e-6);
  // What one correction leaves is not taken for solved where few digits are demanded.
  std::vector<double> product;
  JacobianProduct<3> jacobian(blocks);
  for (const double tolerance : {0.05, 0.002}) {
    const auto loose = solver.solve(artery().b(), tolerance, x);
    EXPECT_TRUE(loose.converged);
    jacobian.multiply(x, product);
    EXPECT_LE(relative_difference(product, artery().b()), tolerance);
  }
}

TEST(FastSolver, LooseTolerancesAreMetWithFewerIterations) {
  FastSolver<3> solver(artery().blocks(), iterative());
  solver.update();
  std::vector<double> x, product;
  JacobianProduct<3> jacobian(artery().blocks());
  int last = 0;
  for (double tolerance : {1e-1, 1e-3, 1e-6}) {
    const auto report = solver.solve(artery().b(), tolerance, x);
    jacobian.multiply(x, product);
    const double residual = relative_difference(product, artery().b());
    EXPECT_LE(residual, tolerance);
    // Loose ones are met by a bound, from what the inner iteration estimates in single precision.
    if (tolerance >= 1e-3) {
      EXPECT_LE(residual, 1.001 * report.relative_residual) << tolerance;
      EXPECT_GE(residual, 0.5 * report.relative_residual) << tolerance;
    } else {
      EXPECT_NEAR(residual, report.relative_residual, 1e-12);
    }
    EXPECT_GT(report.iterations, last);
    last = report.iterations;
  }
}

class FlowPreconditioners : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(FastSolver, FlowPreconditioners, ::testing::ValuesIn(flow_preconditioner_names()));

TEST_P(FlowPreconditioners, SolveTheArteryWithinFewIterations) {
  FastOptions options = iterative();
  options.preconditioner = GetParam();
  FastSolver<3> solver(artery().blocks(), options);
  solver.update();
  std::vector<double> x;
  const LinearReport report = solver.solve(artery().b(), 1e-8, x);
  EXPECT_TRUE(report.converged) << report.failure;
  EXPECT_LE(report.iterations, 120);
  EXPECT_FALSE(solver.uses_factorisation());
  EXPECT_LT(relative_difference(x, artery().solution()), 1e-6);
}

TEST(FlowPreconditioner, AnUnknownNameIsRefusedWithThoseThereAre) {
  VelocityPressureLayout<3> layout(artery().blocks());
  VelocityPressureMatrix<3> matrix(artery().blocks(), layout);
  try {
    make_flow_preconditioner<3>("simples", matrix);
    FAIL();
  } catch (const InputError& error) {
    const std::string text = error.what();
    for (const auto& name : flow_preconditioner_names()) EXPECT_NE(text.find(name), std::string::npos) << text;
  }
}

/// Half of the product of F with the answer of block-factors is known from its last sweep.
TEST_P(FlowPreconditioners, KnowTheProductWithTheirAnswer) {
  VelocityPressureLayout<3> layout(artery().blocks());
  VelocityPressureMatrix<3> matrix(artery().blocks(), layout);
  matrix.fill();
  for (const auto& [sweeps, coarse_from] :
       {std::pair(1, 1e30), std::pair(2, 1e30), std::pair(1, 0.0), std::pair(2, 0.0)}) {
    BlockPreconditionerChoices choices;
    choices.momentum_sweeps = sweeps;
    choices.coarse_from = coarse_from;
    const auto preconditioner = make_flow_preconditioner<3>(GetParam(), matrix);
    preconditioner->set_up(choices);
    std::vector<double> right(layout.size());
    Random random(5);
    for (double& value : right) value = random();
    std::vector<float> r(matrix.size()), z(r), alone(r), product(z), expected(z);
    matrix.take(right, 1, r);
    preconditioner->apply(r, alone);
    preconditioner->apply(r, z, product);
    EXPECT_EQ(z, alone);
    matrix.multiply(z, expected);
    double apart = 0, whole = 0;
    for (std::size_t i = 0; i < product.size(); ++i) {
      apart += std::pow(product[i] - expected[i], 2);
      whole += std::pow(expected[i], 2);
    }
    EXPECT_LT(std::sqrt(apart / whole), 3e-6) << sweeps << ' ' << coarse_from;
  }
}

TEST(FastSolver, ZeroRightHandSide) {
  FastSolver<3> solver(artery().blocks(), iterative());
  solver.update();
  std::vector<double> x{1};
  const std::vector<double> zero(artery().b().size(), 0.0);
  EXPECT_TRUE(solver.solve(zero, 1e-8, x).converged);
  EXPECT_EQ(x, zero);
}

TEST(FastSolver, SmallSystemsAreFactorised) {
  FastSolver<3> solver(artery().blocks());
  solver.update();
  EXPECT_TRUE(solver.uses_factorisation());
  EXPECT_STREQ(solver.preparation(), "factorisation");
  std::vector<double> x;
  EXPECT_TRUE(solver.solve(artery().b(), 1e-8, x).converged);
  EXPECT_LT(relative_difference(x, artery().solution()), 1e-12);
}

TEST(FastSolver, AFactorisationFollowsWhenTheIterationFails) {
  FastOptions options = iterative();
  options.max_iterations = 2;
  FastSolver<3> solver(artery().blocks(), options);
  solver.update();
  std::vector<double> x;
  const auto report = solver.solve(artery().b(), 1e-9, x);
  EXPECT_TRUE(report.converged);
  EXPECT_TRUE(solver.uses_factorisation());
  EXPECT_LT(relative_difference(x, artery().solution()), 1e-9);
}

TEST(FastSolver, SameBitsForAnyNumberOfThreads) {
  const int before = threads();
  std::vector<double> one, two;
  for (const auto& [count, x] : {std::pair(1, &one), std::pair(2, &two)}) {
    set_threads(count);
    FastSolver<3> solver(artery().blocks(), iterative());
    solver.update();
    solver.solve(artery().b(), 1e-8, *x);
  }
  set_threads(before);
  EXPECT_EQ(one, two);
}

/// A sub-problem of the artery under its own numbering, assembled at the coupled state.
template <int n>
void expect_sub_problem_solved(Scene<n>& scene, Numbering numbering, int most_iterations) {
  System<n> system("part", scene, std::move(numbering));
  State state = scene.at_rest();
  StepData data;
  data.rates = scene.integrator->rates(state, 0.125);
  if (scene.fluid) data.opening_pressures = {1.332};
  if (scene.wall) data.interface_load.assign(scene.at_rest().now.wall.size(), 1e-3);
  system.work_on(state, data);
  system.evaluate();
  system.linearise();
  DirectLinearSolver<n> direct(system.blocks());
  direct.update();
  std::vector<double> expected, x;
  direct.solve(system.residual(), 0, expected);
  FastSolver<n> solver(system.blocks(), iterative());
  solver.update();
  const auto report = solver.solve(system.residual(), 1e-10, x);
  EXPECT_TRUE(report.converged);
  EXPECT_FALSE(solver.uses_factorisation());
  EXPECT_LE(report.iterations, most_iterations);
  EXPECT_LT(relative_difference(x, expected), 1e-7);
}

TEST(FastSolver, SolvesTheFluidAlone) {
  expect_sub_problem_solved(artery().scene(), number_fluid(artery().scene()), 30);
}

TEST(FastSolver, SolvesTheWallAlone) {
  expect_sub_problem_solved(artery().scene(), number_wall(artery().scene()), 40);
}

TEST(FastSolver, SolvesTheCoupledSystemOfALargeTimeStepAtRest) {
  auto setup = coupled_case("neo-hookean");
  setup.time->step = 5;
  setup.time->end = 50;
  ArteryOptions options;
  options.length = 6;
  const auto parts = build_scene<P1Tetrahedron>(setup, generate_artery(options));
  LinearisedScene<3> scene(setup, *parts, 0, 1);
  FastSolver<3> solver(scene.blocks(), iterative());
  solver.update();
  std::vector<double> x;
  const auto report = solver.solve(scene.b(), 1e-10, x);
  EXPECT_TRUE(report.converged);
  EXPECT_FALSE(solver.uses_factorisation());
  EXPECT_LE(report.iterations, 60);
  EXPECT_LT(relative_difference(x, scene.solution()), 1e-7);
}

/// A piece of it with a pressure for each layer: several nodes of the wall have one velocity.
TEST(FastSolver, SolvesWithPressuresPerLayer) {
  auto setup = coupled_case("artery");
  setup.structure->layer_pressure = LayerPressure::separate;
  ArteryOptions options;
  options.length = 3;
  const auto parts = build_scene<P1Tetrahedron>(setup, generate_artery(options));
  LinearisedScene<3> scene(setup, *parts, 2, 2);
  EXPECT_TRUE(parts->wall->nodes().has_copies());
  FastSolver<3> solver(scene.blocks(), iterative());
  solver.update();
  std::vector<double> x;
  const auto report = solver.solve(scene.b(), 1e-10, x);
  EXPECT_TRUE(report.converged);
  EXPECT_FALSE(solver.uses_factorisation());
  EXPECT_LE(report.iterations, 40);
  EXPECT_LT(relative_difference(x, scene.solution()), 1e-7);
  expect_sub_problem_solved(*parts, number_wall(*parts), 40);
}

TEST(FastSolver, SolvesWithPressuresPerLayerAndTaylorHoodElements) {
  auto setup = coupled_case("artery");
  setup.structure->layer_pressure = LayerPressure::separate;
  ArteryShape shape;
  shape.length = 3;
  ArteryCells cells;
  cells.axial = 8;
  const auto parts =
      build_scene<P2P1AxisymmetricTriangle>(setup, with_mid_edge_nodes(generate_artery_section(shape, cells)));
  LinearisedScene<2> scene(setup, *parts, 2, 2);
  FastSolver<2> solver(scene.blocks(), iterative());
  solver.update();
  std::vector<double> x;
  const auto report = solver.solve(scene.b(), 1e-9, x);
  EXPECT_TRUE(report.converged);
  EXPECT_FALSE(solver.uses_factorisation());
  EXPECT_LT(relative_difference(x, scene.solution()), 1e-6);
}

/// A static, pressurised wall: no inertia holds the momentum matrix together, so that sweeps without coarse levels need
/// hundreds of iterations.
std::unique_ptr<Scene<3>> static_wall(const std::string& level) {
  auto setup = coupled_case("neo-hookean");
  setup.fluid.reset();
  setup.inlet.reset();
  setup.time.reset();
  setup.static_load = StaticData{};
  setup.load = PressureTable{{{0.0, 0.1}}};
  ArteryOptions options = artery_level(level);
  options.length = 6;
  return build_scene<P1Tetrahedron>(setup, generate_artery(options));
}

TEST(FastSolver, SolvesAStaticWallOnACoarseMesh) {
  const auto scene = static_wall("coarse");
  expect_sub_problem_solved(*scene, number_wall(*scene), 40);
}

TEST(FastSolver, SolvesAStaticWallOnAFinerMeshInAboutAsManyIterations) {
  const auto scene = static_wall("intermediate");
  expect_sub_problem_solved(*scene, number_wall(*scene), 45);
}

/// Nodes that are held in some components only, and nodes without pressure.
void expect_partly_fixed_solved(Numbering numbering, bool vectors, bool scalars, int most_iterations) {
  PartlyFixedSystem<3> system(artery().scene(), std::move(numbering), vectors, scalars);
  FastSolver<3> solver(system.blocks(), iterative());
  solver.update();
  std::vector<double> x;
  const auto report = solver.solve(system.b, 1e-10, x);
  EXPECT_TRUE(report.converged);
  EXPECT_FALSE(solver.uses_factorisation());
  EXPECT_LE(report.iterations, most_iterations);
  EXPECT_LT(relative_difference(x, system.solution), 1e-6);
}

TEST(FastSolver, NodesHeldInOneComponent) {
  expect_partly_fixed_solved(number_scene(artery().scene()), true, false, 60);
}

TEST(FastSolver, NodesWithoutPressure) {
  expect_partly_fixed_solved(number_scene(artery().scene()), false, true, 60);
}

TEST(FastSolver, NodesOfThePartsHeldInOneComponentAndWithoutPressure) {
  expect_partly_fixed_solved(number_fluid(artery().scene()), true, true, 60);
  expect_partly_fixed_solved(number_wall(artery().scene()), true, true, 60);
}

TEST(FastSolver, TheCoarseLevelsOfAStaticWallKnowHeldComponents) {
  const auto scene = static_wall("coarse");
  PartlyFixedSystem<3> system(*scene, number_wall(*scene), true, false, 0.05);
  FastSolver<3> solver(system.blocks(), iterative());
  solver.update();
  std::vector<double> x;
  const auto report = solver.solve(system.b, 1e-10, x);
  EXPECT_TRUE(report.converged);
  EXPECT_FALSE(solver.uses_factorisation());
  EXPECT_LE(report.iterations, 80);
  EXPECT_LT(relative_difference(x, system.solution), 1e-6);
}

// The step's length may change from one update to the next: nothing of the last one stays.
TEST(FastSolver, StepsOfDifferentLength) {
  Scene<3>& scene = artery().scene();
  System<3> system("coupled", scene, number_scene(scene));
  FastSolver<3> fast(system.blocks(), iterative());
  DirectLinearSolver<3> direct(system.blocks());
  std::vector<std::vector<double>> solutions;
  for (double step : {0.125, 0.05, 0.125}) {
    State state = scene.at_rest();
    StepData data;
    data.rates = scene.integrator->rates(state, step);
    data.opening_pressures = {1.332};
    system.work_on(state, data);
    system.evaluate();
    system.linearise();
    std::vector<double> expected, x;
    direct.update();
    direct.solve(system.residual(), 0, expected);
    fast.update();
    EXPECT_TRUE(fast.solve(system.residual(), 1e-10, x).converged);
    EXPECT_FALSE(fast.uses_factorisation());
    EXPECT_LT(relative_difference(x, expected), 1e-7) << step;
    solutions.push_back(x);
  }
  EXPECT_EQ(solutions[2], solutions[0]);
  EXPECT_GT(relative_difference(solutions[1], solutions[0]), 0.1);
}

}  // namespace

}  // namespace fsi::test
