// Layers of Kelvin and Voigt's kind (docs/theory.md, section 5.10): exact derivatives, the creep of a block against its
// ordinary differential equation, and the energy that they take.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "support/differences.hpp"
#include "support/element_meshes.hpp"
#include "support/errors.hpp"
#include "support/every_element.hpp"
#include "support/problems.hpp"
#include "support/pulled_block.hpp"
#include "support/random.hpp"
#include "time/time_schemes.hpp"
#include "wall/viscous_layers.hpp"

namespace fsi::test::viscous_walls_tests {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

template <class Element>
class ViscousWallOf : public testing::Test {};
TYPED_TEST_SUITE(ViscousWallOf, Elements, ElementNames);

TYPED_TEST(ViscousWallOf, JacobianIsTheDerivativeOfTheResidual) {
  using Element = TypeParam;
  constexpr int n = Element::components;
  auto mesh = irregular_mesh<Element>(2, "media");
  curve<Element>(mesh, 0.05);
  WallProblem<Element> wall(whole(mesh), {1.2, 50.0, 0.5}, {{0, Material{NeoHookean{3}}}}, {});
  const auto solution = random_field(mesh.nodes, n + 1, 0.1, 0.02, 1);
  const auto reference = random_field(mesh.nodes, n + 1, 0.1, 0.02, 2);
  const auto history = random_field(mesh.nodes, n, 1.0, 0.1, 3);
  const auto residual_at = [&](const std::vector<double>& at, WallMatrix<n>* jacobian = nullptr) {
    WallInput in{at.data(), history.data(), 16.0};
    in.velocity_reference = reference.data();
    in.velocity_rate = 4;
    in.strain_lag = 0.1;
    std::vector<double> r;
    EXPECT_FALSE(wall.assemble(in, 0, at, r, jacobian).inverted());
    return r;
  };
  const auto elastic = residual_at(solution);
  EXPECT_FALSE(wall.is_viscous());
  wall.set_viscosity(0, 2.5);
  EXPECT_TRUE(wall.is_viscous());
  WallMatrix<n> jacobian(wall.graph());
  const auto at_state = residual_at(solution, &jacobian);
  EXPECT_GT(norm(difference(at_state, elastic)), 0.3 * norm(elastic)) << "a viscosity that can be seen";
  EXPECT_LT(norm(difference(at_state, residual_at(solution))), 1e-14 * norm(at_state)) << "two loops, one residual";
  const auto direction = random_field(mesh.nodes, n + 1, 0.3, 0.1, 4);
  expect_second_order(central_differences(
      "viscous wall", [&](double t) { return residual_at(moved(solution, t, direction)); },
      multiply(jacobian, direction), 0.05, 16));
}

// A wall that turns about an axis, however far, has no rate of strain: F^T grad v is skew where v = w x (x + d).
TEST(KelvinVoigt, TakesNothingFromARotation) {
  const double c = std::cos(0.8), s = std::sin(0.8), rate = 3;
  Mat3<Pack> turned{}, spin{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) turned(i, j) = spin(i, j) = Pack(0.0);
  turned(0, 0) = turned(1, 1) = Pack(c - 1);
  turned(0, 1) = Pack(-s);
  turned(1, 0) = Pack(s);
  spin(0, 0) = spin(1, 1) = Pack(-rate * s);
  spin(0, 1) = Pack(-rate * c);
  spin(1, 0) = Pack(rate * c);
  const auto still = KelvinVoigt{2}.prepare(turned, spin);
  EXPECT_NEAR(still.power[0], 0, 1e-28);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(still.flux(i, j)[0], 0, 1e-15);
}

// Nor does a step of it: between two places of a rigid body no strain changes, whatever the angle.
TEST(KelvinVoigt, TakesNothingFromAStepOfARotation) {
  constexpr double step = 0.25, angle = 0.4;
  Mat3<Pack> turned{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) turned(i, j) = Pack(0.0);
  turned(0, 0) = turned(1, 1) = Pack(std::cos(angle) - 1);
  turned(0, 1) = Pack(-std::sin(angle));
  turned(1, 0) = Pack(std::sin(angle));
  // The velocity is that of the whole way, whose middle lies half a step before the balance.
  const Mat3<Pack> velocity = Pack(1 / step) * turned;
  const auto still = KelvinVoigt{2, step / 2}.prepare(turned, velocity);
  EXPECT_NEAR(still.power[0], 0, 1e-28);
  EXPECT_GT((KelvinVoigt{2}.prepare(turned, velocity).power[0]), 1e-3) << "with F of the balance";
}

// --- creep -----------------------------------------------------------------------------------------------------------

constexpr double mu = 6, eta = 9, pull = 1.5, end = 3;  // kPa, kPa ms, kPa/ms, ms

/// A block under a traction `pull` t along one axis, free across: with the stretch l, in three dimensions,
///   pull t = mu (l - l^-2) + eta (l^2 + l^-4 / 2) dl/dt,
/// in plane strain
///   pull t = mu (l - l^-3) + eta (l^2 + l^-6) dl/dt,
/// of the axial and the vanishing lateral traction without their pressure; by Runge and Kutta's rule of fourth order.
double creep(bool plane) {
  const auto rate = [plane](double l, double time) {
    return plane ? (pull * time - mu * (l - std::pow(l, -3))) / (eta * (l * l + std::pow(l, -6)))
                 : (pull * time - mu * (l - std::pow(l, -2))) / (eta * (l * l + 0.5 * std::pow(l, -4)));
  };
  constexpr int steps = 2000;
  const double h = end / steps;
  double l = 1;
  for (int i = 0; i < steps; ++i) {
    const double t = i * h, k1 = rate(l, t), k2 = rate(l + h / 2 * k1, t + h / 2), k3 = rate(l + h / 2 * k2, t + h / 2),
                 k4 = rate(l + h * k3, t + h);
    l += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return l;
}

/// The block computed: neo-Hookean, with a viscosity.
template <class Element>
PulledBlock computed_creep(const std::string& scheme, int steps, double viscosity = eta) {
  MaterialData layer = layer_of("neo-hookean", {{"c10", mu}});
  layer.viscosity = viscosity;
  const PulledBlock block = pulled_block<Element>(layer, scheme, steps, end, pull);
  EXPECT_EQ(block.viscous, viscosity > 0);
  return block;
}

TYPED_TEST(ViscousWallOf, BlockCreepsAsItsEquationSays) {
  using Element = TypeParam;
  const double exact = creep(Element::dim == 2 && !Element::axisymmetric);
  ConvergenceTable errors("creep of a block, tr-bdf2", {"stretch"});
  for (const int steps : {6, 12}) {
    const PulledBlock block = computed_creep<Element>("tr-bdf2", steps);
    errors.add(end / steps, {std::abs(block.stretch - exact)});
    EXPECT_LT(block.left_over, 1e-7 * block.work);
  }
  errors.print();
  EXPECT_GT(exact, 1.15);
  EXPECT_NEAR(errors.last_order(0), 2, 0.3);
  EXPECT_LT(errors.last_error(0), 1e-3);
}

TEST(Creep, IsOfTheOrderOfTheSchemeInTime) {
  using Element = P1AxisymmetricTriangle;
  const double exact = creep(false);
  for (const auto& [scheme, order] : {std::pair{"euler", 1}, std::pair{"midpoint", 2}, std::pair{"bdf2", 2}}) {
    ConvergenceTable errors(scheme, {"stretch"});
    for (const int steps : {20, 40, 80})
      errors.add(end / steps, {std::abs(computed_creep<Element>(scheme, steps).stretch - exact)});
    errors.print();
    EXPECT_NEAR(errors.last_order(0), order, 0.25) << scheme;
  }
}

// What the traction does goes into the elastic energy and the viscosity, but for what the scheme takes: of first order,
// since the stress is that of the balance and not along the step (docs/energy.md).
TEST(Creep, DissipatesWhatItDoesNotStore) {
  using Element = P1AxisymmetricTriangle;
  const PulledBlock coarse = computed_creep<Element>("bdf2", 40), viscous = computed_creep<Element>("bdf2", 80),
                    elastic = computed_creep<Element>("bdf2", 80, 0);
  fmt::print("work {:.4f} uJ, stored {:.4f}, dissipated {:.4f}\n", viscous.work, viscous.stored, viscous.dissipated);
  const auto taken = [](const PulledBlock& creep) { return creep.work - creep.stored - creep.dissipated; };
  EXPECT_LT(std::abs(taken(viscous)), 0.02 * viscous.work);
  EXPECT_NEAR(std::log2(taken(coarse) / taken(viscous)), 1, 0.2);
  EXPECT_GT(viscous.dissipated, 0.3 * viscous.work);
  EXPECT_EQ(elastic.dissipated, 0);
  EXPECT_LT(viscous.stretch, elastic.stretch);
}

}  // namespace

}  // namespace fsi::test::viscous_walls_tests
