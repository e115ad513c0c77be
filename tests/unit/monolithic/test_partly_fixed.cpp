// The block methods and the coupled multigrid where nodes are held in some components only or carry no pressure.
#include <gtest/gtest.h>

#include <cmath>

#include "algebra/vector_operations.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "monolithic/coupled_solvers/coupled_linear_solver.hpp"
#include "support/partly_fixed.hpp"
#include "support/scenes.hpp"

namespace fsi::test {

namespace {

using Tet = P1Tetrahedron;

/// Relative error of the solution to 1e-10 of the residual.
double error_of(const CoupledSolverOptions& options, bool vectors, bool scalars) {
  const auto scene = build_scene<P1Tetrahedron>(coupled_case("artery"), fluid_and_wall_box(5));
  PartlyFixedSystem<3> system(*scene, number_scene(*scene), vectors, scalars);
  CoupledLinearSolver<3> solver(system.blocks(), options);
  solver.update();
  std::vector<double> x;
  const auto report = solver.solve(system.b, 1e-10, x);
  EXPECT_TRUE(report.converged) << report.failure;
  axpy(-1, system.solution, x);
  return norm(x) / norm(system.solution);
}

CoupledSolverOptions exact_blocks() {
  CoupledSolverOptions options;
  options.block_preconditioner = "lower";
  options.multigrid.coarsening.max_levels = 1;
  options.krylov.max_iterations = 400;
  options.krylov.restart = 400;
  return options;
}
CoupledSolverOptions coupled_cycle() {
  CoupledSolverOptions options;
  options.multigrid.coarsening.coarsest_nodes = 60;
  options.krylov.max_iterations = 200;
  options.krylov.restart = 200;
  return options;
}

TEST(PartlyFixed, BlockPreconditionerWithNodesHeldInOneComponent) {
  EXPECT_LT(error_of(exact_blocks(), true, false), 1e-5);
}

TEST(PartlyFixed, BlockPreconditionerWithNodesWithoutPressure) {
  EXPECT_LT(error_of(exact_blocks(), false, true), 1e-5);
}

TEST(PartlyFixed, CoupledMultigridWithNodesHeldInOneComponent) {
  EXPECT_LT(error_of(coupled_cycle(), true, false), 1e-5);
}

}  // namespace

}  // namespace fsi::test
