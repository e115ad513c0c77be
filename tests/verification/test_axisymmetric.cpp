// The same weak forms on triangles of a body of revolution: Jacobians, patch states, observed orders are those of the
// element.

#include <gtest/gtest.h>

#include <cmath>

#include "fem/p1_triangle.hpp"
#include "sub_problem_jacobians.hpp"
#include "support/meshes.hpp"
#include "support/problems.hpp"
#include "system/newton_stepper.hpp"

namespace fsi::test::axisymmetric_tests {

namespace {

using Triangle = P1AxisymmetricTriangle;

[[maybe_unused]] const int single_thread = set_threads(1);

TEST(AxisymmetricJacobian, OfTheFluidInEveryBlock) {
  for (const bool grad_div : {false, true}) {
    const auto mesh = irregular_ring(3);
    FluidProblem<Triangle> fluid(whole(mesh), strongly_coupled_fluid(grad_div), {});
    check_fluid_blocks(fluid, FluidState<Triangle>(mesh.nodes), "axisymmetric fluid", {1, 2});
  }
}

TEST(AxisymmetricJacobian, OfTheWallInEveryBlock) {
  for (const auto& [name, layer, stretch] :
       {std::tuple{"axisymmetric neo-Hookean", Material{NeoHookean{3}}, 1.2},
        std::tuple{"axisymmetric artery", Material{Artery{3, 2.3632, 0.8393, 1, 29}}, 1.3}}) {
    const auto mesh = irregular_ring(3, "media");
    std::vector<TriangleMesh::Facet> inner;
    for (const auto& side : boundary_sides(mesh))
      if (mesh.nodes[side[0]][0] == 1 && mesh.nodes[side[1]][0] == 1) inner.push_back(side);
    ASSERT_EQ(inner.size(), 3u);
    WallProblem<Triangle> wall(whole(mesh), {1.2, 50.0, 0.5}, {{0, layer}}, {}, inner);
    auto solution = random_field(mesh.nodes, 3, 0.05, 0.01, 21);
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
      solution[3 * a] += (stretch - 1) * mesh.nodes[a][0];  // the circumference stretches: fibres tight everywhere
      solution[3 * a + 2] *= 20;
    }
    check_wall_blocks(wall, solution, random_field(mesh.nodes, 2, 10.0, 1.0, 22), 16.0, 2.0, name, {1, 2});
  }
}

TEST(AxisymmetricJacobian, OfTheMeshMotion) {
  const auto mesh = irregular_ring(3);
  FluidProblem<Triangle> fluid(whole(mesh), strongly_coupled_fluid(false), {});
  MeshMotionMatrix<2> matrix(fluid.graph());
  assemble_mesh_motion(fluid.packs(), matrix);
  const auto state = random_field(mesh.nodes, 2, 0.3, 0.1, 41), direction = random_field(mesh.nodes, 2, 0.3, 0.1, 42);
  std::vector<double> product(direction.size());
  multiply_mesh_motion<2>(matrix, direction, product);
  expect_exact(central_differences(
      "axisymmetric mesh motion",
      [&](double t) { return mesh_motion_residual<Triangle>(fluid.packs(), moved(state, t, direction)); }, product));
}

// d = (a r, b z) has zero Laplacian and equal radial and hoop strain a: exact on any mesh.
TEST(AxisymmetricPatch, MeshMotionReproducesHomogeneousStretch) {
  const auto mesh = irregular_ring(4);
  const auto boundary = boundary_marks(mesh);
  FluidProblem<Triangle> fluid(whole(mesh), {}, {});
  MeshMotionMatrix<2> matrix(fluid.graph());
  assemble_mesh_motion(fluid.packs(), matrix);
  MeshMotionEquilibrium<Triangle> problem(matrix, [&](int a, int) { return boundary[a] != 0; });
  std::vector<double> exact(problem.solution.size());
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    exact[2 * a] = 0.3 * mesh.nodes[a][0];
    exact[2 * a + 1] = -0.2 * mesh.nodes[a][2] + 0.1;
  }
  for (std::size_t i = 0; i < exact.size(); ++i) problem.solution[i] = boundary[i / 2] ? exact[i] : 0.0;
  EXPECT_GT(largest(difference(problem.solution, exact)), 0.1);
  newton(problem, {});
  EXPECT_LT(largest(difference(problem.solution, exact)), 1e-13);
}

// F = diag(a, a, b) in (radial, hoop, axial) with p = -kappa (J - 1): constant and in equilibrium for isotropic
// materials.
TEST(AxisymmetricPatch, WallReproducesHomogeneousStretch) {
  const auto mesh = irregular_ring(4, "media");
  const auto boundary = boundary_marks(mesh);
  const double kappa = 1e5, pressure = 2.5, a = 1.2, b = (1 - pressure / kappa) / (a * a);
  for (const Material& layer : {Material{NeoHookean{3}}, Material{MooneyRivlin{3, 0.3}}}) {
    WallProblem<Triangle> wall(whole(mesh), {1.2, kappa, 0.5}, {{0, layer}}, {});
    WallEquilibrium<Triangle> problem(wall, [&](int node, int k) { return k < 2 && boundary[node]; });
    std::vector<double> exact(problem.solution.size());
    for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
      exact[3 * node] = (a - 1) * mesh.nodes[node][0];
      exact[3 * node + 1] = (b - 1) * mesh.nodes[node][2];
      exact[3 * node + 2] = pressure;
    }
    const auto noise = random_field(mesh.nodes, 3, 0.0, 0.02, 3);
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const bool prescribed = boundary[i / 3] && i % 3 < 2;
      problem.solution[i] = prescribed ? exact[i] : (i % 3 < 2 ? exact[i] + noise[i] : 0.0);
    }
    NewtonOptions options;
    options.tolerance = 1e-12;
    EXPECT_TRUE(newton(problem, options).converged);
    const auto error = difference(problem.solution, exact);
    EXPECT_LT(largest(only(error, 3, 0, 2)), 1e-10);
    EXPECT_LT(largest(only(error, 3, 2, 1)), 1e-10 * kappa / 100);
  }
}

// At rest under an inlet pressure while the mesh moves: as in three dimensions.
TEST(AxisymmetricPatch, HydrostaticPressureFillsAVesselAtRest) {
  const auto mesh = irregular_ring(4);
  const auto boundary = boundary_marks(mesh);
  std::vector<TriangleMesh::Facet> inlet;
  for (const auto& side : boundary_sides(mesh))
    if (mesh.nodes[side[0]][2] == 0 && mesh.nodes[side[1]][2] == 0) inlet.push_back(side);
  FluidProblem<Triangle> fluid(whole(mesh), {1.0, 3.5e-3, false, 0.125},
                               {open_boundary<Triangle>("inlet", mesh.nodes, inlet)});
  FluidStep<Triangle> step(fluid, [&](int a, int k) {
    const auto& x = mesh.nodes[a];
    return k < 2 && boundary[a] && !(x[2] == 0 && x[0] > 1 && x[0] < 2);
  });
  step.pressures = {1.332};
  step.mesh = random_field(mesh.nodes, 2, 0.3, 0.01, 1);
  for (std::size_t i = 0; i < step.mesh.size(); ++i)
    if (boundary[i / 2]) step.mesh[i] = 0;
  NewtonOptions options;
  options.tolerance = 1e-13;
  ASSERT_TRUE(newton(step, options).converged);
  // Exact only as far as the quadrature is: see below.
  EXPECT_LT(largest(only(step.solution, 3, 0, 2)), 1e-12);
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) EXPECT_NEAR(step.solution[3 * a + 2], 1.332, 1e-11);
}

}  // namespace

}  // namespace fsi::test::axisymmetric_tests
