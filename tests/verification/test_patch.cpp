// Patch tests: states that the equations hold exactly for must come out exactly on any mesh.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "fem/p1_tetrahedron.hpp"
#include "scene/build_scene.hpp"
#include "support/meshes.hpp"
#include "support/problems.hpp"
#include "support/random.hpp"

namespace fsi::test::patch_tests {

namespace {

using Tet = P1Tetrahedron;

[[maybe_unused]] const int single_thread = set_threads(1);

struct NamedMaterial {
  const char* name;
  Material layer;
};
void PrintTo(const NamedMaterial& material, std::ostream* out) {
  *out << material.name;
}

const NamedMaterial materials[] = {{"neo_Hookean", NeoHookean{3}},
                                   {"Mooney_Rivlin", MooneyRivlin{3, 0.3}},
                                   {"artery", Artery{3, 2.3632, 0.8393, 1, 29}}};

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}
Point times(const Matrix& a, const Point& x) {
  Point y{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) y[i] += a[i][j] * x[j];
  return y;
}
Matrix rotation(double a, double b) {
  return product({{{std::cos(a), -std::sin(a), 0}, {std::sin(a), std::cos(a), 0}, {0, 0, 1}}},
                 {{{1, 0, 0}, {0, std::cos(b), -std::sin(b)}, {0, std::sin(b), std::cos(b)}}});
}

// --- wall ------------------------------------------------------------------------------------------------------------

class WallPatch : public testing::TestWithParam<NamedMaterial> {};
INSTANTIATE_TEST_SUITE_P(Materials, WallPatch, testing::ValuesIn(materials),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(WallPatch, RigidMotionsGiveNoStress) {
  const auto mesh = irregular_cube(3, 0.15, "media");
  const CylinderAxis axis{{{-0.7, -0.4, 0}}, {{0, 0, 1}}};
  WallProblem<Tet> wall(whole(mesh), {1.2, 1e5, 0.5}, {{0, GetParam().layer}}, axis);
  for (const auto& r : {rotation(0.0, 0.0), rotation(0.3, -0.2), rotation(2.5, 1.3)}) {
    std::vector<double> solution(4 * mesh.nodes.size(), 0.0), residual;
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
      const Point turned = times(r, mesh.nodes[a]);
      for (int i = 0; i < 3; ++i) solution[4 * a + i] = turned[i] - mesh.nodes[a][i] + 0.5 * (i + 1);
    }
    wall.assemble({solution.data(), nullptr, 0.0}, 0, solution, residual);
    // Forces of rounding: modulus times element faces times 1e-16; a strain of 1e-6 would already give 1e-7.
    EXPECT_LT(largest(residual), 1e-14) << "forces and volume changes on all nodes, boundary included";
  }
}

// A homogeneous deformation and the pressure p = -kappa (J - 1) satisfy momentum and volume equation exactly; with the
// displacement prescribed on the boundary of an irregular mesh the interior must follow, pressures everywhere.
TEST_P(WallPatch, HomogeneousDeformationIsReproduced) {
  const auto mesh = irregular_cube(3, 0.2, "media");
  const auto boundary = boundary_marks(mesh);
  // The axis lies so far away that fibre directions are alike everywhere to 1e-12.
  const CylinderAxis axis{{{-1e12, 0, 0}}, {{0, 0, 1}}};
  for (const double kappa : {50.0, 1e5}) {
    WallProblem<Tet> wall(whole(mesh), {1.2, kappa, 0.5}, {{0, GetParam().layer}}, axis);
    const double pressure = 2.5;
    // An isochoric stretch and shear that tightens the fibres, turned, then shrunk to J = 1 - p / kappa.
    Matrix f = product(rotation(0.4, -0.3), {{{1 / (1.2 * 1.1), 0.15, -0.1}, {0, 1.2, 0.2}, {0, 0, 1.1}}});
    for (auto& row : f)
      for (double& entry : row) entry *= std::cbrt(1 - pressure / kappa);

    WallEquilibrium<Tet> problem(wall, [&](int a, int k) { return k < 3 && boundary[a]; });
    std::vector<double> exact(problem.solution.size());
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
      const Point x = times(f, mesh.nodes[a]);
      for (int i = 0; i < 3; ++i) exact[4 * a + i] = x[i] - mesh.nodes[a][i] + 0.1;
      exact[4 * a + 3] = pressure;
    }
    // Start: exact on the boundary, off by up to 0.02 mm inside, no pressure.
    const auto noise = random_field(mesh.nodes, 4, 0.0, 0.02, 3);
    problem.solution = moved(exact, 1, noise);
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
      for (int i = 0; i < 3; ++i)
        if (boundary[a]) problem.solution[4 * a + i] = exact[4 * a + i];
      problem.solution[4 * a + 3] = 0;
    }
    EXPECT_GT(largest(difference(problem.solution, exact)), 0.01);
    NewtonOptions options;
    options.tolerance = 1e-12;
    const auto report = newton(problem, options);
    EXPECT_TRUE(report.converged) << report.failure;
    const auto error = difference(problem.solution, exact);
    fmt::print("{}, kappa {}: displacement error {:.1e} mm, pressure error {:.1e} kPa\n", GetParam().name, kappa,
               largest(only(error, 4, 0, 3)), largest(only(error, 4, 3, 1)));
    EXPECT_LT(largest(only(error, 4, 0, 3)), 1e-10);
    EXPECT_LT(largest(only(error, 4, 3, 1)), 1e-10 * std::max(1.0, kappa / 100)) << "kappa times the rounding of J - 1";
  }
}

// A free body under outer pressure p shrinks to J = 1 - p / kappa without shear, p_s = p: sign and size of the follower
// load against the stress, without any prescribed displacement but the rigid motions.
TEST_P(WallPatch, FreeBodyUnderUniformPressureChangesItsVolumeAlone) {
  const auto mesh = irregular_cube(3, 0.2, "media");
  const double kappa = 50, pressure = 2.5, shrink = std::cbrt(1 - pressure / kappa);
  WallProblem<Tet> wall(whole(mesh), {1.2, kappa, 0.5}, {{0, GetParam().layer}}, {},
                        facets_where(mesh, "media", [](const Point&) { return true; }));
  // Corner (0,0,0) held; (1,0,0) along y and z, (0,1,0) along z: no rigid motion is left and no force arises.
  const auto is = [&](int a, const Point& x) { return mesh.nodes[a] == x; };
  WallEquilibrium<Tet> problem(wall, [&](int a, int k) {
    return k < 3 && (is(a, {0, 0, 0}) || (is(a, {1, 0, 0}) && k > 0) || (is(a, {0, 1, 0}) && k == 2));
  });
  problem.pressure = pressure;
  NewtonOptions options;
  options.tolerance = 1e-12;
  const auto report = newton(problem, options);
  EXPECT_TRUE(report.converged) << report.failure;
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(problem.solution[4 * a + i], (shrink - 1) * mesh.nodes[a][i], 1e-10);
    EXPECT_NEAR(problem.solution[4 * a + 3], pressure, 1e-10);
  }
}

// --- fluid -----------------------------------------------------------------------------------------------------------

/// The fluid in a cube whose boundary velocity is prescribed; the pressure is fixed at node 0.
struct ClosedFluid {
  TetrahedralMesh mesh = irregular_cube(4, 0.2);
  std::vector<char> boundary = boundary_marks(mesh);
  FluidProblem<Tet> fluid;
  FluidStep<Tet> step;

  explicit ClosedFluid(const AleFluid& form)
      : fluid(whole(mesh), form, {}), step(fluid, [this](int a, int k) { return k < 3 ? boundary[a] != 0 : a == 0; }) {}

  Point position(std::size_t a, const std::vector<double>& displacement) const {
    Point x = mesh.nodes[a];
    for (int i = 0; i < 3; ++i) x[i] += displacement[3 * a + i];
    return x;
  }
  /// Nodal values of (u, p) = flow(x, t) on the mesh as displaced.
  template <class Flow>
  std::vector<double> nodal(Flow flow, const std::vector<double>& displacement) const {
    std::vector<double> values;
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
      for (double value : flow(position(a, displacement))) values.push_back(value);
    return values;
  }
  /// Solves a step from the boundary values of `exact`, zero inside; returns the largest error.
  double solve_and_compare(const std::vector<double>& exact) {
    for (std::size_t i = 0; i < exact.size(); ++i) step.solution[i] = boundary[i / 4] && i % 4 < 3 ? exact[i] : 0.0;
    step.solution[3] = exact[3];
    NewtonOptions options;
    options.tolerance = 1e-13;
    const auto report = newton(step, options);
    EXPECT_TRUE(report.converged) << report.failure;
    return largest(difference(step.solution, exact));
  }
};

using Flow = std::array<double, 4>;

// Parallel shear u = (g z, 0, 0) with constant pressure: zero acceleration, constant stress, zero residual.
TEST(FluidPatch, LinearShearFlowIsReproducedOnADeformedMesh) {
  for (const bool grad_div : {false, true}) {
    ClosedFluid box({1.3, 0.03, grad_div, 0.5});
    box.step.mesh = random_field(box.mesh.nodes, 3, 0.3, 0.01, 1);
    box.step.mesh_old = box.step.mesh;
    const auto exact = box.nodal([](const Point& x) { return Flow{2 * x[2] + 0.3, 0.0, 0.0, 1.7}; }, box.step.mesh);
    box.step.fluid_old = exact;
    EXPECT_LT(box.solve_and_compare(exact), 1e-10);
  }
}

// In creeping flow, here with a density so small that inertia vanishes, any linear solenoidal field with constant
// pressure is a solution of Stokes' equations.
TEST(FluidPatch, AnyLinearSolenoidalFieldIsReproducedInCreepingFlow) {
  ClosedFluid box({1e-13, 0.03, false, 0.5});
  box.step.mesh = random_field(box.mesh.nodes, 3, 0.3, 0.01, 1);
  box.step.mesh_old = box.step.mesh;
  const Matrix a{{{0.8, 1.1, -0.4}, {0.3, -1.3, 0.9}, {-0.7, 0.2, 0.5}}};
  const auto exact = box.nodal(
      [&](const Point& x) {
        const Point u = times(a, x);
        return Flow{u[0], u[1], u[2], 1.7};
      },
      box.step.mesh);
  box.step.fluid_old = exact;
  EXPECT_LT(box.solve_and_compare(exact), 1e-10);
}

// Geometric conservation. In this non-conservative form a uniform flow has no gradient and no acceleration whatever the
// mesh does, so it stays uniform to rounding; a linear shear flow likewise, since u(x^n) - u(x^(n-1)) at the nodes is
// what grad u w takes away, and the mesh velocity of linear elements is linear. Claimed for any motion that inverts no
// element.
TEST(GeometricConservation, UniformAndShearFlowSurviveArbitraryMeshMotion) {
  ClosedFluid box({1.0, 3.5e-3, false, 0.125});
  const auto flows = {std::pair{"uniform",
                                +[](const Point&) {
                                  return Flow{3.0, -1.0, 2.0, 0.7};
                                }},
                      std::pair{"shear", +[](const Point& x) {
                                  return Flow{3.0 + 2 * x[2], -1.0, 0.0, 0.7};
                                }}};
  for (const auto& [name, flow] : flows) {
    const std::vector<double> at_rest(3 * box.mesh.nodes.size(), 0.0);
    box.step.mesh = at_rest;
    box.step.fluid_old = box.nodal(flow, box.step.mesh);
    double error = 0, smallest = 1, greatest = 1;
    for (unsigned n = 1; n <= 5; ++n) {
      box.step.mesh_old = box.step.mesh;
      box.step.mesh = random_field(box.mesh.nodes, 3, 0.4, 0.012, n);
      const auto exact = box.nodal(flow, box.step.mesh);
      // How far the mesh moves: J over the elements.
      for (const auto& pack : box.fluid.packs().of_thread(0)) {
        NodalVector<Tet> d{};
        gather<VectorLayout<3>>(d, pack, box.step.mesh.data());
        const Pack j = deformation(gradient_of(d, Tet::at(pack.geometry, 0))).volume_ratio;
        for (int lane = 0; lane < pack_width; ++lane)
          smallest = std::min(smallest, j[lane]), greatest = std::max(greatest, j[lane]);
      }
      error = std::max(error, box.solve_and_compare(exact));
      box.step.fluid_old = box.step.solution;
    }
    fmt::print("{} flow, 5 steps, J from {:.2f} to {:.2f}: error {:.1e}\n", name, smallest, greatest, error);
    EXPECT_LT(smallest, 0.5);
    EXPECT_GT(greatest, 1.5);
    EXPECT_LT(error, 1e-11);
  }
}

// Uniform acceleration b in a closed box: u = b t, p = -rho b . x. Backward Euler is exact for linear growth and the
// PSPG term sees a zero residual, so also this is reproduced, on a moving mesh.
TEST(GeometricConservation, UniformlyAcceleratedFlowWithItsLinearPressure) {
  ClosedFluid box({1.3, 3.5e-3, false, 0.125});
  const double b[3] = {2.0, -1.0, 0.5};
  const auto flow = [&](double t) {
    return [&b, t](const Point& x) {
      return Flow{b[0] * t, b[1] * t, b[2] * t, -1.3 * (b[0] * x[0] + b[1] * x[1] + b[2] * x[2])};
    };
  };
  box.step.mesh = random_field(box.mesh.nodes, 3, 0.3, 0.01, 1);
  box.step.fluid_old = box.nodal(flow(0), box.step.mesh);
  for (unsigned n = 1; n <= 3; ++n) {
    box.step.mesh_old = box.step.mesh;
    box.step.mesh = random_field(box.mesh.nodes, 3, 0.3, 0.01, n + 1);
    EXPECT_LT(box.solve_and_compare(box.nodal(flow(n * 0.125), box.step.mesh)), 1e-11);
    box.step.fluid_old = box.step.solution;
  }
}

// A closed vessel with one open face under pressure p_in: at rest, p = p_in everywhere, while the mesh inside moves.
// Sign of the inlet's traction, and the null space of the pressure gradient on moving meshes.
TEST(FluidPatch, HydrostaticPressureFillsAVesselAtRestWhileTheMeshMoves) {
  const auto mesh = irregular_cube(4, 0.2);
  const auto boundary = boundary_marks(mesh);
  const auto inlet = facets_where(mesh, "fluid", [](const Point& x) { return x[0] == 0; });
  FluidProblem<Tet> fluid(whole(mesh), {1.0, 3.5e-3, false, 0.125}, {open_boundary<Tet>("inlet", mesh.nodes, inlet)});
  FluidStep<Tet> step(fluid, [&](int a, int k) {
    const auto& x = mesh.nodes[a];
    const bool open = x[0] == 0 && x[1] > 0 && x[1] < 1 && x[2] > 0 && x[2] < 1;
    return k < 3 && boundary[a] && !open;
  });
  step.pressures = {1.332};
  for (unsigned n = 1; n <= 3; ++n) {
    step.mesh_old = step.mesh;
    step.mesh = random_field(mesh.nodes, 3, 0.3, 0.01, n);
    for (std::size_t i = 0; i < step.mesh.size(); ++i)
      if (boundary[i / 3]) step.mesh[i] = 0;
    NewtonOptions options;
    options.tolerance = 1e-13;
    const auto report = newton(step, options);
    EXPECT_TRUE(report.converged) << report.failure;
    EXPECT_LT(largest(only(step.solution, 4, 0, 3)), 1e-12);
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) EXPECT_NEAR(step.solution[4 * a + 3], 1.332, 1e-11);
    step.fluid_old = step.solution;
  }
}

// --- mesh motion -----------------------------------------------------------------------------------------------------

TEST(MeshMotionPatch, AffineDisplacementIsReproduced) {
  const auto mesh = irregular_cube(4, 0.2);
  const auto boundary = boundary_marks(mesh);
  FluidProblem<Tet> fluid(whole(mesh), {}, {});
  MeshMotionMatrix<3> matrix(fluid.graph());
  assemble_mesh_motion(fluid.packs(), matrix);
  MeshMotionEquilibrium<Tet> problem(matrix, [&](int a, int) { return boundary[a] != 0; });
  const Matrix g{{{0.3, -0.2, 0.1}, {0.4, 0.1, -0.3}, {-0.1, 0.2, 0.5}}};
  std::vector<double> exact(problem.solution.size());
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    const Point d = times(g, mesh.nodes[a]);
    for (int i = 0; i < 3; ++i) exact[3 * a + i] = d[i] + 0.2;
  }
  for (std::size_t i = 0; i < exact.size(); ++i) problem.solution[i] = boundary[i / 3] ? exact[i] : 0.0;
  EXPECT_GT(largest(difference(problem.solution, exact)), 0.1);
  newton(problem, {});
  EXPECT_LT(largest(difference(problem.solution, exact)), 1e-13);
}

}  // namespace

}  // namespace fsi::test::patch_tests
