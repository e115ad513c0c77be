// Walls with laws of a finite bulk modulus: the inflation of a thick tube against Lame's solution and against the
// equilibrium of a radius solved as an ordinary differential equation, and Cook's membrane against a published value.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "fem/p1_triangle.hpp"
#include "fem/p2p1_triangle.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "support/errors.hpp"
#include "support/meshes.hpp"
#include "support/problems.hpp"

namespace fsi::test::compressible_walls_tests {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

constexpr double young = 10, inner = 1, outer = 1.4;  // kPa, mm

Material material(const std::string& name, double poisson) {
  return make_material(name, {{"young", young}, {"poisson", poisson}});
}

template <class Element, class Mesh>
auto of_element(const Mesh& mesh) {
  if constexpr (Element::order == 1)
    return mesh;
  else
    return with_mid_edge_nodes(mesh);
}

/// The radial displacement of the inner face, mm, of a tube held along its axis: a ring of m times 2 squares.
template <class Element>
double inflated(const Material& layer, double pressure, int m) {
  constexpr int n = Element::components;
  const double h = (outer - inner) / m;
  const auto linear = triangle_grid(
      {m, 2}, {"wall"},
      [&](int i, int j) {
        return Point{inner + i * h, 0, j * h};
      },
      [](int, int) { return 0; });
  auto mesh = of_element<Element>(linear);
  typename WallProblem<Element>::Facets loaded;
  for (const auto& facet : boundary_facets(mesh))
    if (mesh.nodes[facet.nodes[0]][0] == inner && mesh.nodes[facet.nodes[1]][0] == inner) loaded.push_back(facet.nodes);
  WallProblem<Element> wall(whole(mesh), {1.2, 0, 0.5}, {{0, layer}}, {}, loaded);
  WallEquilibrium<Element> tube(
      wall, [&](int node, int entry) { return entry == 1 || (entry == n && !wall.space().carries_scalar(node)); });
  NewtonOptions options;
  options.mode = NewtonMode::full;
  options.tolerance = 1e-10;
  const int steps = pressure > 0.01 ? 4 : 1;
  for (int s = 1; s <= steps; ++s) {
    tube.pressure = pressure * s / steps;
    const auto report = newton(tube, options);
    EXPECT_TRUE(report.converged) << report.failure;
  }
  for (int a = 0; a < wall.node_count(); ++a)
    if (mesh.nodes[a][0] == inner && mesh.nodes[a][2] == 0) return tube.solution[MixedLayout<n>::vector(a, 0)];
  return NAN;
}

template <class Element>
ConvergenceTable inflation_errors(const std::string& title, const Material& layer, double pressure, double exact,
                                  const std::vector<int>& meshes) {
  ConvergenceTable table(title, {"u/u - 1"});
  for (int m : meshes) table.add(1.0 / m, {std::abs(inflated<Element>(layer, pressure, m) / exact - 1)});
  table.print();
  return table;
}

// u = (1 + nu)/E p A^2/(B^2 - A^2) ((1 - 2 nu) A + B^2/A). The load is small: it follows the face, whose growth counts
// as u/A, 1e-8 here.
TEST(CompressibleWalls, ThickTubeOfLinearElasticityIsLames) {
  const double pressure = 1e-8 * young, a2 = inner * inner, b2 = outer * outer;
  for (double nu : {0.0, 0.3, 0.4999}) {
    const double exact = (1 + nu) / young * pressure * a2 / (b2 - a2) * ((1 - 2 * nu) * inner + b2 / inner);
    const auto name = fmt::format("linear elastic, nu = {}", nu);
    const auto p1 = inflation_errors<P1AxisymmetricTriangle>(name + ", P1", material("linear-elastic", nu), pressure,
                                                             exact, {4, 8, 16});
    EXPECT_GT(p1.last_order(0), 1.85);
    EXPECT_LT(p1.last_error(0), 1e-3);
    const auto p2 = inflation_errors<P2P1AxisymmetricTriangle>(name + ", P2P1", material("linear-elastic", nu),
                                                               pressure, exact, {2, 4, 8});
    EXPECT_GT(p2.last_order(0), 2.8);
    EXPECT_LT(p2.last_error(0), 2e-5);
  }
}

/// A law in principal stretches (radial, circumferential; 1 along the axis), P_i = dPsi/dl_i, kPa.
using PrincipalStress = std::function<std::pair<double, double>(double radial, double hoop)>;

PrincipalStress saint_venant_kirchhoff(double nu) {
  const double mu = young / (2 * (1 + nu)), lambda = young * nu / ((1 + nu) * (1 - 2 * nu));
  return [=](double r, double t) {
    const double er = (r * r - 1) / 2, et = (t * t - 1) / 2, sum = lambda * (er + et);
    return std::pair{r * (sum + 2 * mu * er), t * (sum + 2 * mu * et)};
  };
}
PrincipalStress neo_hookean(double nu) {
  const double mu = young / (2 * (1 + nu)), lambda = young * nu / ((1 + nu) * (1 - 2 * nu));
  return [=](double r, double t) {
    const double volumetric = lambda * std::log(r * t);
    return std::pair{mu * (r - 1 / r) + volumetric / r, mu * (t - 1 / t) + volumetric / t};
  };
}

/// The radial stretch for which the radial stress is p, by bisection near 1: both laws stiffen there.
double radial_stretch(const PrincipalStress& law, double hoop, double p) {
  double low = 0.6, high = 1.4;
  for (int k = 0; k < 52; ++k) {
    const double middle = (low + high) / 2;
    (law(middle, hoop).first < p ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// Pressure that holds the tube at the inner radius a: dP_r/dR = (P_t - P_r)/R, P_r = -p a/A on the inner face and 0 on
/// the outer one, dr/dR the radial stretch. Shooting with Runge and Kutta's rule of fourth order; p by the secant rule.
double pressure_at(const PrincipalStress& law, double a) {
  constexpr int steps = 200;
  const double h = (outer - inner) / steps;
  const auto outer_stress = [&](double p) {
    double r = a, stress = -p * a / inner;
    const auto slope = [&](double at, double radius, double s) {
      const double hoop = radius / at, radial = radial_stretch(law, hoop, s);
      return std::pair{radial, (law(radial, hoop).second - s) / at};
    };
    for (int k = 0; k < steps; ++k) {
      const double at = inner + k * h;
      const auto [r1, s1] = slope(at, r, stress);
      const auto [r2, s2] = slope(at + h / 2, r + h / 2 * r1, stress + h / 2 * s1);
      const auto [r3, s3] = slope(at + h / 2, r + h / 2 * r2, stress + h / 2 * s2);
      const auto [r4, s4] = slope(at + h, r + h * r3, stress + h * s3);
      r += h / 6 * (r1 + 2 * r2 + 2 * r3 + r4);
      stress += h / 6 * (s1 + 2 * s2 + 2 * s3 + s4);
    }
    return stress;
  };
  double p0 = 0.2, p1 = 0.4, f0 = outer_stress(p0), f1 = outer_stress(p1);
  for (int k = 0; k < 20 && std::abs(p1 - p0) > 1e-13; ++k) {
    const double p2 = p1 - f1 * (p1 - p0) / (f1 - f0);
    p0 = p1, f0 = f1, p1 = p2, f1 = outer_stress(p2);
  }
  return p1;
}

TEST(CompressibleWalls, ThickTubeAtLargeStrainsIsThatOfTheRadialEquation) {
  const double stretch = 1.2;
  for (double nu : {0.0, 0.3, 0.49})
    for (const auto& [name, law] : {std::pair{"saint-venant-kirchhoff", saint_venant_kirchhoff(nu)},
                                    std::pair{"compressible-neo-hookean", neo_hookean(nu)}}) {
      const double pressure = pressure_at(law, stretch * inner), exact = (stretch - 1) * inner;
      EXPECT_GT(pressure, 0.3);
      const auto title = fmt::format("{}, nu = {}", name, nu);
      const auto p1 =
          inflation_errors<P1AxisymmetricTriangle>(title + ", P1", material(name, nu), pressure, exact, {4, 8, 16});
      EXPECT_GT(p1.last_order(0), 1.8);
      EXPECT_LT(p1.last_error(0), 2e-3);
      const auto p2 =
          inflation_errors<P2P1AxisymmetricTriangle>(title + ", P2P1", material(name, nu), pressure, exact, {2, 4, 8});
      EXPECT_GT(p2.last_order(0), 2.7);
      EXPECT_LT(p2.last_error(0), 5e-5);
    }
}

/// The tip's rise, mm, of Cook's membrane (48 x 44 x 16 mm, plane strain) under a shear traction of 6.25 MPa at its
/// end.
template <class Element>
double cooks_tip(const Material& layer, int m) {
  constexpr int n = Element::components;
  const auto linear = triangle_grid(
      {m, m}, {"wall"},
      [&](int i, int j) {
        const double x = 48.0 * i / m, low = 44 * x / 48, high = 44 + 16 * x / 48;
        return Point{x, low + (high - low) * j / m, 0};
      },
      [](int, int) { return 0; });
  const auto mesh = of_element<Element>(linear);
  WallProblem<Element> wall(whole(mesh), {1, 40094e3, 0.5}, {{0, layer}}, {});
  WallEquilibrium<Element> membrane(wall, [&](int node, int entry) {
    return entry == n ? !wall.space().carries_scalar(node) : mesh.nodes[node][0] == 0;
  });
  std::vector<double> load(membrane.solution.size(), 0.0);
  using Facet = typename Element::Facet;
  int tip = 0;
  for (const auto& facet : boundary_facets(mesh)) {
    if (mesh.nodes[facet.nodes[0]][0] != 48 || mesh.nodes[facet.nodes[1]][0] != 48) continue;
    for (int node : facet.nodes)
      if (mesh.nodes[node][1] > mesh.nodes[tip][1]) tip = node;
    Vec3<Pack> x[Facet::nodes];
    facet_corners<Facet>(mesh.nodes, facet.nodes, x);
    for (int q = 0; q < Facet::points; ++q)
      for (int a = 0; a < Facet::nodes; ++a)
        load[MixedLayout<n>::vector(facet.nodes[a], 1)] +=
            6.25e3 * Facet::shape(q, a) * Facet::weighted_normal(x, q)[0][0];
  }
  NewtonOptions options;
  options.mode = NewtonMode::full;
  options.max_iterations = 60;
  const int steps = 5;
  for (int s = 1; s <= steps; ++s) {
    membrane.load = load;
    for (double& f : membrane.load) f *= static_cast<double>(s) / steps;
    const auto report = newton(membrane, options);
    EXPECT_TRUE(report.converged) << report.failure;
  }
  return membrane.solution[MixedLayout<n>::vector(tip, 1)];
}

// G = 80.1938 MPa, K = 40,094 MPa: the tip rises by 6.891 mm with 30 elements a side (OpenGeoSys' documentation,
// F-bar); elements that lock stop at 2.3 to 4.7 mm.
TEST(CompressibleWalls, CooksMembraneRisesAsPublished) {
  const double shear = 80193.8, bulk = 40094e3;
  const Material mixed = make_material("neo-hookean", {{"c10", shear}}),
                 own = make_material("compressible-neo-hookean", {{"c10", shear}, {"bulk_modulus", bulk}});
  for (const auto& layer : {mixed, own}) {
    const double quadratic = cooks_tip<P2P1PlaneTriangle>(layer, 16), linear = cooks_tip<P1PlaneTriangle>(layer, 32);
    fmt::print("tip: {:.4f} mm, 16 Taylor-Hood elements a side; {:.4f} mm, 32 linear ones\n", quadratic, linear);
    EXPECT_NEAR(quadratic, 6.891, 0.005 * 6.891);
    EXPECT_NEAR(linear, 6.891, 0.02 * 6.891);
  }
}

}  // namespace

}  // namespace fsi::test::compressible_walls_tests
