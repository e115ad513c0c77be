#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "algebra/vector_operations.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "mesher/artery_generator.hpp"
#include "monolithic/linear_solvers.hpp"
#include "support/axisymmetric_artery.hpp"
#include "support/linear_systems.hpp"

namespace fsi::test::linear_solvers_tests {

namespace {

constexpr double tolerance = 1e-9;  // on |b - K x| / |b|, as the paper's tables

/// The paper's artery: the pulse lasts one step.
Case artery_case(const std::string& material) {
  Case setup = coupled_case(material);
  setup.inlet = PressureTable{{{0.0, 1.332}, {0.125, 1.332}, {0.125, 0.0}}};
  setup.time->end = 12;
  return setup;
}

/// A Newton system of the artery, made once per set of arguments.
LinearisedScene<3>& artery_system(const std::string& material, const std::string& level, int finished_steps,
                                  int iteration) {
  struct Made {
    std::unique_ptr<Scene<3>> scene;
    std::unique_ptr<LinearisedScene<3>> system;
  };
  static std::map<std::string, Made> made;
  auto& entry = made[material + level + std::to_string(finished_steps) + ":" + std::to_string(iteration)];
  if (!entry.system) {
    const Case setup = artery_case(material);
    entry.scene = build_scene<P1Tetrahedron>(setup, generate_artery(artery_level(level)));
    entry.system = std::make_unique<LinearisedScene<3>>(setup, *entry.scene, finished_steps, iteration);
  }
  return *entry.system;
}

/// Second Newton system of the step to t = 1.5 ms: shape derivatives, convection and fibres are all there.
LinearisedScene<3>& deformed(const std::string& material, const std::string& level = "coarse") {
  return artery_system(material, level, 11, 2);
}

struct Outcome {
  LinearReport report;
  std::vector<double> x;
};

template <int n>
Outcome solve(LinearisedScene<n>& system, const std::string& name) {
  const auto solver = make_linear_solver<n>(name, system.setup(), system.blocks());
  solver->update();
  Outcome outcome;
  outcome.report = solver->solve(system.b(), tolerance, outcome.x);
  EXPECT_TRUE(outcome.report.converged) << name << ": " << outcome.report.failure;
  EXPECT_LE(outcome.report.relative_residual, tolerance) << name;
  return outcome;
}

template <int n>
void expect_solution(LinearisedScene<n>& system, const std::string& name) {
  auto x = solve(system, name).x;
  axpy(-1, system.solution(), x);
  EXPECT_LT(norm(x), 1e-7 * norm(system.solution())) << name;
}

class EveryLinearSolver : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
#ifndef FSI_WITH_MPI
    if (GetParam() == "petsc") GTEST_SKIP() << "a build without MPI";
#endif
  }
};

TEST_P(EveryLinearSolver, AgreesWithTheFactorisationOfADeformedArtery) {
  expect_solution(deformed("artery"), GetParam());
}

TEST_P(EveryLinearSolver, SolvesTheAxisymmetricArteryToo) {
  static fsi::test::AxisymmetricArtery artery("artery", 1);
  static LinearisedScene<2> system(
      [] {
        Case setup = artery.setup();
        setup.monolithic.multigrid.coarsening.coarsest_nodes = 60;  // of 300: three levels
        return setup;
      }(),
      artery.scene(), 11, 2);
  expect_solution(system, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Names, EveryLinearSolver, ::testing::ValuesIn(linear_solver_names()),
                         [](const auto& of) { return of.param; });

// Paper, Table 4: with one multigrid cycle for each inverse, not many more iterations than with factorisations, and the
// same order: diagonal needs most, the triangular ones half of that, ssor and ilu no more than these.
TEST(BlockPreconditioners, NeedAtMostAThirdMoreIterationsThanWithExactInverses) {
  for (auto* system : {&artery_system("neo-hookean", "coarse", 0, 1), &deformed("artery")}) {
    std::map<std::string, int> count;
    for (const std::string name : {"diagonal", "lower", "upper", "ssor", "ilu"})
      for (const std::string& variant : {name, name + "_exact"})
        count[variant] = solve(*system, variant).report.iterations;
    for (const std::string name : {"diagonal", "lower", "upper", "ssor", "ilu"})
      EXPECT_LE(count[name], 1.3 * count[name + "_exact"]) << name;
    for (const std::string end : {"", "_exact"}) {
      EXPECT_GT(count["diagonal" + end], 1.5 * count["lower" + end]);
      EXPECT_GT(count["diagonal" + end], 1.5 * count["upper" + end]);
      EXPECT_LE(count["ssor" + end], count["lower" + end]);
      EXPECT_LE(count["ilu" + end], count["lower" + end]);
    }
  }
}

// Paper, Table 5, least of the three materials in each cell, here with five steps before and five after the coarse
// correction. Stand-alone, in GMRES and in FGMRES.
TEST(CoupledMultigrid, NeedsNoMoreIterationsThanThePaper) {
  const std::map<std::string, std::map<std::string, int>> paper = {
      {"coarse", {{"amg", 7}, {"amg_gmres", 7}, {"amg_fgmres", 6}, {"amli", 7}, {"amli_gmres", 7}, {"amli_fgmres", 6}}},
      {"intermediate", {{"amg", 8}, {"amg_gmres", 7}, {"amli_fgmres", 7}}}};
  for (const auto& [level, methods] : paper)
    for (const auto& [name, iterations] : methods) {
      EXPECT_LE(solve(artery_system("neo-hookean", level, 0, 1), name).report.iterations, iterations)
          << name << ", " << level;
      if (level != "coarse") continue;
      for (const char* material : {"neo-hookean", "mooney-rivlin", "artery"})
        EXPECT_LE(solve(deformed(material), name).report.iterations, iterations) << name << ", " << material;
    }
}

// The damping follows the mesh: with one factor for all meshes the iteration would diverge on the finer ones.
TEST(CoupledMultigrid, UndampedSmootherDiverges) {
  auto& system = artery_system("neo-hookean", "coarse", 0, 1);
  Case setup = system.setup();
  setup.monolithic.multigrid.smoothing.damping = 1;
  setup.linear.krylov.max_iterations = 30;
  const auto solver = make_linear_solver<3>("amg", setup, system.blocks());
  solver->update();
  std::vector<double> x;
  EXPECT_FALSE(solver->solve(system.b(), tolerance, x).converged);
}

}  // namespace

}  // namespace fsi::test::linear_solvers_tests
