// `petsc`, and MUMPS, against the sparse factorisation: the coupled system at a deformed state, its sub-problems, stiff
// walls, all kinds of unknowns.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "fem/p2p1_tetrahedron.hpp"
#include "fem/p2p1_triangle.hpp"
#include "linear/distributed/petsc_direct_solver.hpp"
#include "linear/distributed/petsc_options.hpp"
#include "linear/distributed/petsc_solver.hpp"
#include "linear/interface/central_direct_solver.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesher/artery_generator.hpp"
#include "support/linear_systems.hpp"
#include "support/partly_fixed.hpp"

namespace fsi::test {

namespace {

double relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double error = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    error += (a[i] - b[i]) * (a[i] - b[i]);
    size += b[i] * b[i];
  }
  return std::sqrt(error / size);
}

ArteryOptions short_artery(const std::string& level = "coarse") {
  ArteryOptions options = artery_level(level);
  options.length = 6;
  return options;
}

/// A short, coarse artery of fibred wall in its third step: every block of the Jacobian is there.
LinearisedScene<3>& artery() {
  static LinearisedScene<3> scene(
      coupled_case("artery"), build_scene<P1Tetrahedron>(coupled_case("artery"), generate_artery(short_artery())), 2);
  return scene;
}

template <int n>
void expect_solved(const JacobianBlocks<n>& blocks, const std::vector<double>& b, const std::vector<double>& expected,
                   int most_iterations, double tolerance = 1e-10) {
  PetscSolver<n> solver(blocks);
  EXPECT_FALSE(solver.ready());
  solver.update();
  EXPECT_TRUE(solver.ready());
  std::vector<double> x;
  const auto report = solver.solve(b, tolerance, x);
  EXPECT_TRUE(report.converged) << report.failure;
  EXPECT_FALSE(solver.uses_factorisation());
  EXPECT_LE(report.relative_residual, tolerance);
  EXPECT_LE(report.iterations, most_iterations);
  EXPECT_LT(relative_difference(x, expected), 1e4 * tolerance);
}

template <int n>
void expect_solved(LinearisedScene<n>& scene, int most_iterations, double tolerance = 1e-10) {
  expect_solved(scene.blocks(), scene.b(), scene.solution(), most_iterations, tolerance);
}

TEST(PetscSolver, SolvesTheCoupledSystemAtADeformedState) {
  expect_solved(artery(), 35);
}

TEST(PetscSolver, SolvesItByMultigridForThePressuresAsInLargeSystems) {
  set_petsc_options("-fsi_pressure_pc_type gamg", "");
  expect_solved(artery(), 50);
  set_petsc_options("", "");
}

TEST(PetscSolver, ZeroRightHandSide) {
  PetscSolver<3> solver(artery().blocks());
  solver.update();
  std::vector<double> x{1};
  const std::vector<double> zero(artery().b().size(), 0.0);
  EXPECT_TRUE(solver.solve(zero, 1e-8, x).converged);
  EXPECT_EQ(x, zero);
}

TEST(PetscSolver, AFactorisationFollowsWhenTheIterationFails) {
  FastOptions options;
  options.max_iterations = 2;
  PetscSolver<3> solver(artery().blocks(), options);
  solver.update();
  std::vector<double> x;
  EXPECT_TRUE(solver.solve(artery().b(), 1e-9, x).converged);
  EXPECT_TRUE(solver.uses_factorisation());
  EXPECT_LT(relative_difference(x, artery().solution()), 1e-9);
}

/// A sub-problem under its own numbering, assembled at rest.
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
  std::vector<double> expected;
  direct.solve(system.residual(), 0, expected);
  expect_solved(system.blocks(), system.residual(), expected, most_iterations);
}

TEST(PetscSolver, SolvesTheFluidAlone) {
  expect_sub_problem_solved(artery().scene(), number_fluid(artery().scene()), 40);
}

TEST(PetscSolver, SolvesTheWallAlone) {
  expect_sub_problem_solved(artery().scene(), number_wall(artery().scene()), 50);
}

TEST(PetscSolver, SolvesTheFluidWithItsDomain) {
  expect_sub_problem_solved(artery().scene(), number_fluid_and_domain(artery().scene()), 60);
}

/// No inertia holds the momentum matrix together: without coarse levels sweeps need hundreds of iterations.
TEST(PetscSolver, SolvesAStaticWall) {
  auto setup = coupled_case("neo-hookean");
  setup.fluid.reset();
  setup.inlet.reset();
  setup.time.reset();
  setup.static_load = StaticData{};
  setup.load = PressureTable{{{0.0, 0.1}}};
  const auto scene = build_scene<P1Tetrahedron>(setup, generate_artery(short_artery()));
  expect_sub_problem_solved(*scene, number_wall(*scene), 60);
}

TEST(PetscSolver, SolvesWithPressuresPerLayerAndTaylorHoodElements) {
  auto setup = coupled_case("artery");
  setup.structure->layer_pressure = LayerPressure::separate;
  ArteryShape shape;
  shape.length = 3;
  ArteryCells cells;
  cells.axial = 8;
  const auto parts =
      build_scene<P2P1AxisymmetricTriangle>(setup, with_mid_edge_nodes(generate_artery_section(shape, cells)));
  LinearisedScene<2> scene(setup, *parts, 2, 2);
  expect_solved(scene, 120, 1e-9);
}

TEST(PetscSolver, SolvesTaylorHoodElementsInSpace) {
  ArteryShape shape;
  shape.length = 3;
  ArteryCells cells;
  cells.lumen = 2;
  cells.media = cells.adventitia = 1;
  cells.around = 8;
  cells.axial = 4;
  const auto setup = coupled_case("neo-hookean");
  LinearisedScene<3> scene(setup,
                           build_scene<P2P1Tetrahedron>(setup, with_mid_edge_nodes(generate_artery(shape, cells))), 1);
  expect_solved(scene, 90);
}

TEST(PetscSolver, NodesOfThePartsHeldInOneComponentAndWithoutPressure) {
  PartlyFixedSystem<3> system(artery().scene(), number_scene(artery().scene()), true, true);
  expect_solved(system.blocks(), system.b, system.solution, 90);
}

// Nothing of the last step's stays, neither numbers nor what was made of them.
TEST(PetscSolver, StepsOfDifferentLength) {
  Scene<3>& scene = artery().scene();
  System<3> system("coupled", scene, number_scene(scene));
  PetscSolver<3> petsc(system.blocks());
  PetscDirectSolver<3> mumps(system.blocks());
  DirectLinearSolver<3> direct(system.blocks());
  CentralDirectSolver<3> central(system.blocks());
  std::vector<std::vector<double>> solutions;
  std::vector<int> iterations;
  for (double step : {0.125, 0.02}) {
    State state = scene.at_rest();
    StepData data;
    data.rates = scene.integrator->rates(state, step);
    data.opening_pressures = {1.332};
    system.work_on(state, data);
    system.evaluate();
    system.linearise();
    std::vector<double> expected, x, by_mumps;
    direct.update();
    direct.solve(system.residual(), 0, expected);
    central.update();
    EXPECT_TRUE(central.solve(system.residual(), 0, x).converged);
    EXPECT_EQ(x, expected) << "alone it is the same factorisation";
    petsc.update();
    const auto report = petsc.solve(system.residual(), 1e-10, x);
    EXPECT_TRUE(report.converged);
    EXPECT_LT(relative_difference(x, expected), 1e-7) << step;
    mumps.update();
    EXPECT_TRUE(mumps.solve(system.residual(), 0, by_mumps).converged);
    EXPECT_LT(relative_difference(by_mumps, expected), 1e-9) << step;
    solutions.push_back(x);
    iterations.push_back(report.iterations);
  }
  PetscSolver<3> fresh(system.blocks());  // as after a restart
  fresh.update();
  std::vector<double> x;
  EXPECT_EQ(fresh.solve(system.residual(), 1e-10, x).iterations, iterations.back());
  EXPECT_EQ(x, solutions.back());
  EXPECT_GT(relative_difference(solutions[1], solutions[0]), 0.1);
}

TEST(PetscDirectSolver, ASingularMatrixIsAnError) {
  auto blocks = artery().blocks();
  auto zero = *blocks.mesh_laplacian;
  zero.set_zero();
  blocks.mesh_laplacian = &zero;
  PetscDirectSolver<3> solver(blocks);
  EXPECT_THROW(solver.update(), ConvergenceError);
}

}  // namespace

}  // namespace fsi::test
