#include <gtest/gtest.h>

#include <string>

#include "algebra/vector_operations.hpp"
#include "base/error.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "monolithic/linear_solvers.hpp"
#include "support/linear_systems.hpp"

namespace fsi::test {

namespace {

using Tet = P1Tetrahedron;

class LinearSolverTable : public testing::TestWithParam<std::string> {};

// Unknowns in their order of magnitude, mm, mm/ms and kPa, solve to rounding with `direct`.
TEST_P(LinearSolverTable, EveryNameSolvesTheCoupledSystem) {
  auto& box = linearised_box();
  Case setup = box.setup();
  setup.monolithic.multigrid.coarsening.coarsest_nodes = 50;
  const auto solver = make_linear_solver<3>(GetParam(), setup, box.blocks());
  EXPECT_FALSE(solver->ready());
  solver->update();
  EXPECT_TRUE(solver->ready());
  std::vector<double> x;
  const auto report = solver->solve(box.b(), 1e-11, x);
  EXPECT_TRUE(report.converged) << report.failure;
  EXPECT_LE(report.relative_residual, 1e-11);
  axpy(-1, box.solution(), x);
  EXPECT_LT(norm(x), 1e-7 * norm(box.solution()));
  EXPECT_GT(solver->statistics().memory_mib, 0);
}

TEST_P(LinearSolverTable, UpdateTakesNewValues) {
  auto& box = linearised_box();
  const auto solver = make_linear_solver<3>(GetParam(), box.setup(), box.blocks());
  std::vector<double> first, again;
  solver->update();
  solver->solve(box.b(), 1e-8, first);
  solver->update();
  solver->solve(box.b(), 1e-8, again);
  EXPECT_EQ(first, again) << "the same values, the same bits";
}

INSTANTIATE_TEST_SUITE_P(Names, LinearSolverTable, testing::ValuesIn(linear_solver_names()),
                         [](const auto& of) { return of.param; });

TEST(LinearSolverTable, IterationLimitIsNoConvergence) {
  auto& box = linearised_box();
  Case setup = box.setup();
  setup.monolithic.krylov.max_iterations = 2;
  setup.monolithic.multigrid.coarsening.coarsest_nodes = 50;
  for (const char* name : {"lower", "amg", "amli_fgmres"}) {
    const auto solver = make_linear_solver<3>(name, setup, box.blocks());
    solver->update();
    std::vector<double> x;
    const auto report = solver->solve(box.b(), 1e-12, x);
    EXPECT_FALSE(report.converged) << name;
    EXPECT_EQ(report.iterations, 2) << name;
    EXPECT_FALSE(report.failure.empty()) << name;
  }
}

TEST(LinearSolverTable, CoupledSolversAskForFluidAndWall) {
  Case setup = coupled_case("neo-hookean");
  setup.path = "case.toml";
  setup.structure.reset();
  auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  System<3> system("fluid", *scene, number_scene(*scene));
  try {
    make_linear_solver<3>("amg", setup, system.blocks());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "case.toml: monolithic.linear_solver: \"amg\" is for scenes of fluid and wall; give fast or direct");
  }
  EXPECT_NE(make_linear_solver<3>("direct", setup, system.blocks()), nullptr);
}

}  // namespace

}  // namespace fsi::test
