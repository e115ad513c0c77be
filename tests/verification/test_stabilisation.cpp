// Stabilisation that does not see the time step: the projected pressure term of the fluid and the wall's tau.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fem/p1_tetrahedron.hpp"
#include "sub_problem_jacobians.hpp"
#include "support/axisymmetric_artery.hpp"
#include "support/meshes.hpp"
#include "wall/hyperelastic.hpp"

namespace fsi::test::stabilisation_tests {

namespace {

using Tet = P1Tetrahedron;

[[maybe_unused]] const int single_thread = set_threads(1);

/// Metric of a regular tetrahedron of edge h: the unit over h^2.
Sym3<Pack> regular_metric(double h) {
  Sym3<Pack> metric{};
  for (int i = 0; i < 3; ++i) metric(i, i) = Pack(1 / (h * h));
  return metric;
}

double projected_tau(double wave_speed, double step, double h, double viscosity = 3.5e-3) {
  AleFluid form{1.0, viscosity, false, step};
  form.wave_speed = wave_speed;
  return form.projected_tau(regular_metric(h))[0];
}

TEST(ProjectedPressure, TakesOverWhatTheStepTakesFromTau) {
  // Half the time in which a wave crosses the element, less half the step; viscosity is negligible.
  EXPECT_NEAR(projected_tau(2.0, 1e-3, 0.4, 1e-9), 0.5 * (0.2 - 1e-3), 1e-9);
  EXPECT_NEAR(projected_tau(2.0, 0.1, 0.4, 1e-9), 0.5 * (0.2 - 0.1), 1e-9);
  EXPECT_EQ(projected_tau(2.0, 0.2001, 0.4), 0) << "a wave crosses the element within the step";
}

TEST(ProjectedPressure, IsBoundedByViscosityAsTauIs) {
  const double nu = 1.0, h = 0.01, viscous = h * h / (nu * std::sqrt(36.0 * 3));
  EXPECT_LT(projected_tau(1e-3, 1e-6, h, nu), viscous);
}

/// Continuity rows of the projected term alone, per node.
std::vector<double> projected_rows(const FluidState<Tet>& state, double step) {
  auto form = strongly_coupled_fluid(false);
  const auto mesh = irregular_cube(3);
  const auto input = euler_input(&state.mesh, &state.mesh_old, state.fluid, state.fluid_old, step);
  FluidProblem<Tet> fluid(whole(mesh), form, {});
  std::vector<double> without, with;
  fluid.assemble(input, {}, without);
  fluid.set_wave_speed(0.05);
  fluid.assemble(input, {}, with);
  std::vector<double> rows(without.size() / 4);
  for (std::size_t a = 0; a < rows.size(); ++a) {
    rows[a] = with[4 * a + 3] - without[4 * a + 3];
    for (int i = 0; i < 3; ++i) EXPECT_EQ(with[4 * a + i], without[4 * a + i]) << "momentum is left alone";
  }
  return rows;
}

FluidState<Tet> state_of_last_level() {
  FluidState<Tet> state(irregular_cube(3).nodes);
  state.mesh_old = state.mesh;
  return state;
}

double size(const std::vector<double>& rows) {
  double sum = 0;
  for (double r : rows) sum += r * r;
  return std::sqrt(sum);
}

TEST(ProjectedPressure, LeavesLinearPressuresAlone) {
  auto state = state_of_last_level();
  const double of_rough = size(projected_rows(state, 0.01));
  const auto nodes = irregular_cube(3).nodes;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    double p = 0.3;  // linear on the moved domain
    for (int i = 0; i < 3; ++i) p += (i + 1) * (nodes[a][i] + state.mesh[3 * a + i]);
    state.fluid[4 * a + 3] = state.fluid_old[4 * a + 3] = p;
  }
  EXPECT_LT(size(projected_rows(state, 0.01)), 1e-13 * of_rough);
}

TEST(ProjectedPressure, DampsRoughOnesWhateverTheStep) {
  auto state = state_of_last_level();
  for (std::size_t i = 3; i < state.fluid.size(); i += 4) state.fluid_old[i] = state.fluid[i];
  double damping[2];
  const double steps[] = {1e-2, 1e-5};
  for (int k = 0; k < 2; ++k) {
    const auto rows = projected_rows(state, steps[k]);
    damping[k] = 0;
    for (std::size_t a = 0; a < rows.size(); ++a) damping[k] -= rows[a] * state.fluid[4 * a + 3];
    EXPECT_GT(damping[k], 0);
  }
  EXPECT_NEAR(damping[1] / damping[0], 1, 0.05);
}

TEST(WallStabilisation, KnowsTheInertiaOfWaves) {
  // alpha h^2 / (2 (mu + rho c_w^2)); in statics, where the density is zero, and without waves alpha h^2 / (2 mu).
  const auto flux = [](double density, double wave_speed) {
    Hyperelastic<NeoHookean> form{density, 1e5, 0.5, NeoHookean{0.3}, wave_speed};
    const Vec3<Pack> gradient{{Pack(1.0), Pack(0.0), Pack(0.0)}};
    return -form.stabilisation_flux(deformation(Mat3<Pack>{}), gradient, Pack(0.04))[0][0];
  };
  EXPECT_NEAR(flux(1.2, 0), 0.5 * 0.04 / 0.6, 1e-15);
  EXPECT_NEAR(flux(0, 2), 0.5 * 0.04 / 0.6, 1e-15);
  EXPECT_NEAR(flux(1.2, 2), 0.5 * 0.04 / (2 * (0.3 + 1.2 * 4)), 1e-15);
}

/// Root mean square of the second differences along the axis, from node to node, relative to that of the pressure, Pa.
double roughness(double step, Stabilisation kind) {
  fsi::test::AxisymmetricArtery artery("neo-hookean", 1, step, 0.05, kind);
  while (artery.time() < 1.5 - 1e-9) artery.step();
  const auto line = artery.centre_line();
  double bends = 0, squares = 0;
  for (std::size_t i = 5; i + 5 < line.size(); i += 5) {  // nodes are 0.5 mm apart
    bends += std::pow(line[i - 5] - 2 * line[i] + line[i + 5], 2);
    squares += line[i] * line[i];
  }
  return std::sqrt(bends / squares);
}

TEST(ProjectedPressure, StaysSmoothWhenTheStepFalls) {
  const double coarse = 0.125, fine = coarse / 16;
  const double papers[] = {roughness(coarse, Stabilisation::paper), roughness(fine, Stabilisation::paper)};
  const double own[] = {roughness(coarse, Stabilisation::projected), roughness(fine, Stabilisation::projected)};
  fmt::print("roughness with steps of {} and {} ms: paper {:.3f} {:.3f}, projected {:.3f} {:.3f}\n", coarse, fine,
             papers[0], papers[1], own[0], own[1]);
  EXPECT_GT(papers[1], 1.5 * papers[0]) << "or there is nothing to cure";
  EXPECT_LT(own[1], 1.2 * own[0]);
}

}  // namespace

}  // namespace fsi::test::stabilisation_tests
