#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "algebra/vector_operations.hpp"
#include "base/error.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "fem/p1_triangle.hpp"
#include "fem/p2p1_tetrahedron.hpp"
#include "fem/p2p1_triangle.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesher/artery_generator.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "monolithic/linear_solvers.hpp"
#include "support/linear_systems.hpp"

namespace fsi::test {

namespace {

using Tet = P1Tetrahedron;

class LinearSolverTable : public testing::TestWithParam<std::string> {};

/// Those that this build has.
std::vector<std::string> names_here() {
  std::vector<std::string> names = linear_solver_names();
#ifndef FSI_WITH_MPI
  names.erase(std::remove(names.begin(), names.end(), "petsc"), names.end());
#endif
  return names;
}

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

template <int n>
void expect_solved(const std::string& name, LinearisedScene<n>& scene) {
  const auto solver = make_linear_solver<n>(name, scene.setup(), scene.blocks());
  solver->update();
  std::vector<double> x;
  const auto report = solver->solve(scene.b(), 1e-9, x);
  EXPECT_TRUE(report.converged) << report.failure;
  axpy(-1, scene.solution(), x);
  EXPECT_LT(norm(x), 1e-5 * norm(scene.solution()));
}

/// A short piece of the artery as triangles: of a body of revolution, or of a plane between walls of two layers.
template <class Element>
LinearisedScene<Element::components>& triangles() {
  static LinearisedScene<Element::components> scene = [] {
    ArteryShape shape;
    shape.length = 4;
    ArteryCells cells;
    cells.lumen = 3;
    cells.axial = 8;
    const Case setup = coupled_case("mooney-rivlin");
    auto mesh = generate_artery_section(shape, cells);
    if constexpr (!Element::axisymmetric)
      for (auto& x : mesh.nodes) x = {x[0], x[2], 0};
    if constexpr (Element::order == 1)
      return LinearisedScene<2>(setup, build_scene<Element>(setup, mesh), 1);
    else
      return LinearisedScene<2>(setup, build_scene<Element>(setup, with_mid_edge_nodes(mesh)), 1);
  }();
  return scene;
}

TEST_P(LinearSolverTable, EveryNameSolvesOnTriangles) {
  expect_solved(GetParam(), triangles<P1AxisymmetricTriangle>());
  expect_solved(GetParam(), triangles<P1PlaneTriangle>());
}

// The coupled cycles alone need not converge for Taylor-Hood elements; inside Krylov methods they do.
TEST_P(LinearSolverTable, EveryKrylovMethodSolvesWithTaylorHoodElements) {
  if (GetParam() == "amg" || GetParam() == "amli") GTEST_SKIP() << "an iteration without Krylov method";
  static LinearisedScene<3> box(
      coupled_case("mooney-rivlin"),
      build_scene<P2P1Tetrahedron>(coupled_case("mooney-rivlin"), with_mid_edge_nodes(fluid_and_wall_box(2))), 1);
  expect_solved(GetParam(), box);
  expect_solved(GetParam(), triangles<P2P1AxisymmetricTriangle>());
  expect_solved(GetParam(), triangles<P2P1PlaneTriangle>());
}

INSTANTIATE_TEST_SUITE_P(Names, LinearSolverTable, testing::ValuesIn(names_here()),
                         [](const auto& of) { return of.param; });

TEST(LinearSolverTable, IterationLimitIsNoConvergence) {
  auto& box = linearised_box();
  Case setup = box.setup();
  setup.linear.krylov.max_iterations = 2;
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

// Where layers have pressures of their own, a node of the wall stands in the matrix more than once: the coupled system
// has one row for each.
TEST(LinearSolverTable, CoupledSolversAskForOnePressureWhereLayersMeet) {
  Case setup = coupled_case("neo-hookean");
  setup.path = "case.toml";
  setup.structure->layer_pressure = LayerPressure::separate;
  auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  System<3> system("coupled", *scene, number_scene(*scene));
  for (const std::string& name : names_here()) {
    if (name == "fast" || name == "direct" || name == "petsc") {
      EXPECT_NE(make_linear_solver<3>(name, setup, system.blocks()), nullptr);
      continue;
    }
    try {
      make_linear_solver<3>(name, setup, system.blocks());
      FAIL() << name;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()),
                "case.toml: structure.layer_pressure: \"separate\" does not go with monolithic.linear_solver = \"" +
                    name +
                    "\": the paper's coupled system has one wall pressure where layers meet; set it to "
                    "\"continuous\", or use the linear solvers fast, direct or petsc");
    }
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
    EXPECT_EQ(
        std::string(error.what()),
        "case.toml: monolithic.linear_solver: \"amg\" is for scenes of fluid and wall; give fast, direct or petsc");
  }
  EXPECT_NE(make_linear_solver<3>("direct", setup, system.blocks()), nullptr);
}

}  // namespace

}  // namespace fsi::test
