// Observed orders of convergence of fluid and wall for every element, on manufactured solutions: the load is the weak
// form's integrand at smooth exact fields, integrated against test functions by a rule and shape functions of the
// test's own. That the integrand itself is the right physics is the matter of test_convergence.cpp and of the exact
// solutions.

#include <gtest/gtest.h>

#include <cmath>

#include "fem/elements.hpp"
#include "fluid/fluid_problem.hpp"
#include "support/element_meshes.hpp"
#include "support/errors.hpp"
#include "support/every_element.hpp"
#include "support/exact_fields.hpp"
#include "support/problems.hpp"
#include "wall/hyperelastic.hpp"
#include "wall/wall_problem.hpp"

namespace fsi::test::element_convergence_tests {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

NewtonOptions tight() {
  NewtonOptions options;
  options.tolerance = 1e-10;
  return options;
}

double pressure_at(const Point& x) {
  return 0.8 * std::sin(1.3 * x[0] + 0.9 * x[1] - 1.7 * x[2] + 0.4);
}

/// On the boundary of the box but for its face towards the last axis, where the load stands for the traction. On the
/// axis of a body of revolution only the radial component is given.
template <class Element>
bool given(const Point& x, int k) {
  for (int m = 0; m < Element::dim; ++m) {
    const int i = Element::axis[m];
    const bool low = x[i]<1e-9, high = x[i]> 1 - 1e-9;
    if (Element::axisymmetric && m == 0) {
      if ((low && k == 0) || high) return true;
    } else if (low || (high && m + 1 < Element::dim)) {
      return true;
    }
  }
  return false;
}

/// Adds an integrand at a point to a load.
template <class Element, class Cell>
void add_load(std::vector<double>& load, const Cell& cell, const ElementPoint<Element>& p, const Integrand<Pack>& f) {
  constexpr int n = Element::components;
  for (int a = 0; a < Element::nodes; ++a)
    for (int k = 0; k < n; ++k) {
      const int i = Element::axis[k];
      double sum = f.source[i][0] * p.shape[a];
      for (int j = 0; j < 3; ++j) sum += f.flux(i, j)[0] * p.gradient[a][j];
      if (Element::axisymmetric && k == 0) sum += f.flux(1, 1)[0] * p.shape[a] / p.x[0];
      load[MixedLayout<n>::vector(cell[a], k)] += p.weight * sum;
    }
  for (int a = 0; a < Element::scalar_nodes; ++a)
    load[MixedLayout<n>::scalar(cell[a])] += p.weight * p.scalar_shape[a] * f.scalar_source[0];
}

/// L2 and H1 errors of the vector and L2 error of the scalar of a mixed field.
template <class Element>
std::vector<double> errors(const SimplexMesh<Element::dim, Element::order>& mesh, const std::vector<double>& field,
                           const SineField<Element>& exact) {
  constexpr int n = Element::components;
  double l2 = 0, h1 = 0, scalar = 0;
  visit_points<Element>(mesh, [&](const auto& cell, const ElementPoint<Element>& p) {
    const auto u = discrete_vector<Element>(field, n + 1, cell, p), e = exact.at(p.x);
    double pressure = -pressure_at(p.x);
    for (int a = 0; a < Element::scalar_nodes; ++a)
      pressure += p.scalar_shape[a] * field[MixedLayout<n>::scalar(cell[a])];
    const auto difference = u.value - e.value;
    const auto slopes = u.gradient - e.gradient;
    l2 += p.weight * dot(difference, difference)[0];
    h1 += p.weight * contract(slopes, slopes)[0];
    scalar += p.weight * pressure * pressure;
  });
  return {std::sqrt(l2), std::sqrt(h1), std::sqrt(scalar)};
}

template <class Element>
class ConvergenceOfElement : public testing::Test {
 protected:
  static std::vector<int> sides() {
    if (Element::dim == 2) return Element::order == 1 ? std::vector{8, 16, 32} : std::vector{4, 8, 16};
    return Element::order == 1 ? std::vector{4, 8, 16} : std::vector{2, 4, 6};
  }
  static void expect_orders(const ConvergenceTable& table) {
    table.print();
    if (Element::order == 2) {
      EXPECT_NEAR(table.last_order(0), 3, 0.3);
      EXPECT_NEAR(table.last_order(1), 2, 0.2);
      EXPECT_GT(table.last_order(2), 1.8);
    } else {
      EXPECT_NEAR(table.last_order(0), 2, 0.25);
      EXPECT_NEAR(table.last_order(1), 1, 0.15);
      EXPECT_GT(table.last_order(2), 1);
    }
  }
};

// P1Tetrahedron: test_convergence.cpp.
using OtherElements = testing::Types<P1AxisymmetricTriangle, P1PlaneTriangle, P2P1Tetrahedron, P2P1AxisymmetricTriangle,
                                     P2P1PlaneTriangle>;
TYPED_TEST_SUITE(ConvergenceOfElement, OtherElements, ElementNames);

// On a mesh with curved edges that deforms and moves; bodies of revolution touch their axis. The stabilisation of
// linear elements does not know the load: viscosity makes its tau small.
TYPED_TEST(ConvergenceOfElement, FluidConvergesAtItsOrders) {
  using Element = TypeParam;
  constexpr int n = Element::components;
  const AleFluid form{/*density=*/1.2, /*viscosity=*/Element::stabilised ? 1.0 : 0.05, false, /*step=*/0.5};
  const SineField<Element> d{0.05, 0.3}, d_old{0.04, 1.1}, u{1.0, 0.7}, u_old{0.8, 0.2};
  ConvergenceTable table("fluid", {"u, L2", "u, H1", "p, L2"});
  for (int side : this->sides()) {
    const auto straight = irregular_mesh<Element>(side, "fluid", 0);
    auto mesh = straight;
    curve<Element>(mesh, 0.05);
    FluidProblem<Element> fluid(whole(mesh), form, {});
    FluidStep<Element> step(fluid, [&](int a, int i) {
      return i < n ? given<Element>(straight.nodes[a], i) : !fluid.space().carries_scalar(a);
    });
    for (int a = 0; a < fluid.node_count(); ++a)
      for (int k = 0; k < n; ++k) {
        const Point& x = mesh.nodes[a];
        const int i = Element::axis[k];
        step.mesh[VectorLayout<n>::vector(a, k)] = d.at(x).value[i][0];
        step.mesh_old[VectorLayout<n>::vector(a, k)] = d_old.at(x).value[i][0];
        step.fluid_old[MixedLayout<n>::vector(a, k)] = u_old.at(x).value[i][0];
        if (given<Element>(straight.nodes[a], k)) step.solution[MixedLayout<n>::vector(a, k)] = u.at(x).value[i][0];
      }
    step.load.assign(step.solution.size(), 0.0);
    visit_points<Element>(mesh, [&](const auto& cell, const ElementPoint<Element>& p) {
      const auto now = u.at(p.x), old = u_old.at(p.x), moved = d.at(p.x), moved_old = d_old.at(p.x);
      const Pack rate(1 / form.step);
      const auto k = form.prepare(moved.gradient, now.gradient, Vec3<Pack>{}, Unstabilised{});
      add_load(step.load, cell, p,
               form.integrand(k, rate * (now.value - old.value), now.value - rate * (moved.value - moved_old.value),
                              Pack(pressure_at(p.x))));
    });
    const auto report = newton(step, tight());
    ASSERT_TRUE(report.converged) << report.failure;
    table.add(1.0 / side, errors<Element>(mesh, step.solution, u));
  }
  this->expect_orders(table);
}

TYPED_TEST(ConvergenceOfElement, WallConvergesAtItsOrders) {
  using Element = TypeParam;
  constexpr int n = Element::components;
  const SineField<Element> d{0.15, 0.4};
  const Hyperelastic<MooneyRivlin> form{0.0, 1e4, 0.05, MooneyRivlin{3, 0.3}};
  ConvergenceTable table("wall", {"d, L2", "d, H1", "p, L2"});
  for (int side : this->sides()) {
    const auto straight = irregular_mesh<Element>(side, "media", 0);
    auto mesh = straight;
    curve<Element>(mesh, 0.05);
    WallProblem<Element> wall(whole(mesh), {1.2, form.bulk_modulus, form.stabilisation}, {{0, form.material}}, {});
    WallEquilibrium<Element> problem(wall, [&](int a, int i) {
      return i < n ? given<Element>(straight.nodes[a], i) : !wall.space().carries_scalar(a);
    });
    for (int a = 0; a < wall.node_count(); ++a)
      for (int k = 0; k < n; ++k)
        problem.solution[MixedLayout<n>::vector(a, k)] = d.at(mesh.nodes[a]).value[Element::axis[k]][0];
    problem.load.assign(problem.solution.size(), 0.0);
    visit_points<Element>(mesh, [&](const auto& cell, const ElementPoint<Element>& p) {
      const Vec3<Pack> rest{{Pack(0.0), Pack(0.0), Pack(0.0)}};
      const auto k = form.prepare(d.at(p.x).gradient, rest, Unstabilised{});
      add_load(problem.load, cell, p, form.integrand(k, rest, Pack(pressure_at(p.x)), NoFibres{}));
    });
    const auto report = newton(problem, tight());
    ASSERT_TRUE(report.converged) << report.failure;
    table.add(1.0 / side, errors<Element>(mesh, problem.solution, d));
  }
  this->expect_orders(table);
}

}  // namespace

}  // namespace fsi::test::element_convergence_tests
