#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "fem/facet_load.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "fem/p1_triangle.hpp"
#include "support/pi.hpp"
#include "support/random.hpp"

namespace fsi::test {

namespace {

using Tet = P1Tetrahedron;
using Triangle = P1AxisymmetricTriangle;
using Corners = std::array<std::array<double, 3>, 4>;

/// Positively oriented, no two edges alike.
const Corners irregular{{{0.1, -0.2, 0.3}, {1.2, 0.1, 0.0}, {0.3, 0.9, -0.1}, {0.2, 0.3, 1.4}}};

template <class Element>
typename Element::Geometry geometry_of(const Corners& x) {
  Vec3<Pack> corner[Element::nodes];
  for (int a = 0; a < Element::nodes; ++a)
    for (int i = 0; i < 3; ++i) corner[a][i] = Pack(x[a][i]);
  return Element::geometry(corner);
}

double volume(const Corners& x) {
  double e[3][3];
  for (int s = 0; s < 3; ++s)
    for (int i = 0; i < 3; ++i) e[s][i] = x[s + 1][i] - x[0][i];
  return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
          e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
         6;
}

TEST(Tetrahedron, GradientsReproduceLinearFunctions) {
  const auto g = geometry_of<Tet>(irregular);
  const double slope[3] = {1.7, -0.4, 2.2};
  double gradient[3] = {}, sum[3] = {};
  for (int a = 0; a < 4; ++a) {
    double value = 0.3;
    for (int i = 0; i < 3; ++i) value += slope[i] * irregular[a][i];
    for (int i = 0; i < 3; ++i) {
      gradient[i] += g.gradient[a][i][0] * value;
      sum[i] += g.gradient[a][i][0];
    }
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(gradient[i], slope[i], 1e-15 * 8);
    EXPECT_NEAR(sum[i], 0, 1e-15);
  }
  EXPECT_NEAR(g.measure[0], volume(irregular), 1e-15);
}

// Integral of lambda_a lambda_b over a tetrahedron: V/20 (1 + delta_ab); of lambda_a: V/4.
TEST(Tetrahedron, QuadratureIsExactForQuadratics) {
  const auto g = geometry_of<Tet>(irregular);
  const double v = volume(irregular);
  for (int a = 0; a < 4; ++a) {
    double linear = 0;
    for (int q = 0; q < Tet::points; ++q) linear += Tet::at(g, q).weight[0] * Tet::at(g, q).vectors().value[a];
    EXPECT_NEAR(linear, v / 4, 1e-15);
    for (int b = 0; b < 4; ++b) {
      double mass = 0;
      for (int q = 0; q < Tet::points; ++q) {
        const auto p = Tet::at(g, q);
        mass += p.weight[0] * p.vectors().value[a] * p.vectors().value[b];
      }
      EXPECT_NEAR(mass, v / 20 * (a == b ? 2 : 1), 1e-15);
    }
  }
}

/// Unit edges: (0,0,0), (1,0,0), (1/2, sqrt(3)/2, 0), (1/2, sqrt(3)/6, sqrt(2/3)).
const Corners regular{
    {{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(3.0) / 2, 0}, {0.5, std::sqrt(3.0) / 6, std::sqrt(2.0 / 3)}}};

TEST(Tetrahedron, MetricIsTheIdentityOnTheRegularOneOfUnitEdge) {
  const auto g = geometry_of<Tet>(regular);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(g.metric(i, j)[0], i == j ? 1 : 0, 1e-15);
  EXPECT_NEAR(g.size_squared[0], 1, 1e-15) << "h is its edge";
}

// Edge h: metric I / h^2; stretched by s along x: metric_xx / s^2.
TEST(Tetrahedron, MetricAndSizeScale) {
  Corners x = regular;
  for (auto& corner : x) {
    for (double& c : corner) c *= 0.25;
    corner[0] *= 3;
  }
  const auto g = geometry_of<Tet>(x);
  const double expected[3] = {16.0 / 9, 16, 16};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(g.metric(i, j)[0], i == j ? expected[i] : 0, 1e-13);
  EXPECT_NEAR(g.size_squared[0], std::pow(3.0, 2.0 / 3) / 16, 1e-15);
}

TEST(Tetrahedron, MetricVolumeAndSizeDoNotDependOnTheOrderOfNodes) {
  const auto g = geometry_of<Tet>(irregular);
  for (const auto& order :
       {std::array{1, 2, 0, 3}, std::array{3, 2, 1, 0}, std::array{1, 0, 3, 2}}) {  // even permutations
    Corners x;
    for (int a = 0; a < 4; ++a) x[a] = irregular[order[a]];
    const auto permuted = geometry_of<Tet>(x);
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(permuted.metric.c[k][0], g.metric.c[k][0], 1e-14);
    EXPECT_NEAR(permuted.measure[0], g.measure[0], 1e-15);
    EXPECT_NEAR(permuted.size_squared[0], g.size_squared[0], 1e-15);
  }
}

TEST(Tetrahedron, LanesHoldTheirOwnElements) {
  Random random(1);
  Vec3<Pack> corner[4];
  std::array<Corners, pack_width> x;
  for (int lane = 0; lane < pack_width; ++lane)
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < 3; ++i) {
        x[lane][a][i] = irregular[a][i] + 0.1 * random();
        corner[a][i].set(lane, x[lane][a][i]);
      }
  const auto g = Tet::geometry(corner);
  for (int lane = 0; lane < pack_width; ++lane) {
    EXPECT_NEAR(g.measure[lane], volume(x[lane]), 1e-15);
    EXPECT_EQ(g.gradient[2][1][lane], geometry_of<Tet>(x[lane]).gradient[2][1][0]);
  }
}

TEST(TetrahedronFacet, WeightsAddUpToTheOutwardAreaAndTheRuleIsExactForQuadratics) {
  using F = Tet::Facet;
  Vec3<Pack> corner[3];
  const double x[3][3] = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}};  // area 3, normal +z
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i < 3; ++i) corner[a][i] = Pack(x[a][i]);
  double area[3] = {}, mass[3][3] = {};
  for (int q = 0; q < F::points; ++q) {
    const auto n = F::weighted_normal(corner, q);
    for (int i = 0; i < 3; ++i) area[i] += n[i][0];
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) mass[a][b] += n[2][0] * F::shape(q, a) * F::shape(q, b);
  }
  EXPECT_NEAR(area[0], 0, 1e-16);
  EXPECT_NEAR(area[1], 0, 1e-16);
  EXPECT_NEAR(area[2], 3, 1e-15);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) EXPECT_NEAR(mass[a][b], 3.0 / 12 * (a == b ? 2 : 1), 1e-15);  // A/12 (1 + delta)
}

// --- bodies of revolution --------------------------------------------------------------------------------------------

const Corners ring_triangle{{{1.0, 0, 0.0}, {3.0, 0, 0.5}, {1.5, 0, 2.0}, {}}};

double area(const Corners& x) {
  return 0.5 * ((x[1][0] - x[0][0]) * (x[2][2] - x[0][2]) - (x[2][0] - x[0][0]) * (x[1][2] - x[0][2]));
}

double integral_of_one(const Corners& x) {
  const auto g = geometry_of<Triangle>(x);
  double v = 0;
  for (int q = 0; q < Triangle::points; ++q) v += Triangle::at(g, q).weight[0];
  return v;
}

// Pappus: volume = area times the path of the centroid; a cone of radius R and height H has pi R^2 H / 3.
TEST(AxisymmetricTriangle, VolumesOfACircumscribedBodyAndOfACone) {
  const double centroid = (1.0 + 3.0 + 1.5) / 3;
  EXPECT_NEAR(integral_of_one(ring_triangle), 2 * pi * centroid * area(ring_triangle), 1e-13);
  EXPECT_NEAR(integral_of_one({{{0, 0, 0}, {2, 0, 0}, {0, 0, 3}, {}}}), pi * 4 * 3 / 3, 1e-13);
}

TEST(AxisymmetricTriangle, GradientsReproduceLinearFunctionsAndTheHoopTermIsUOverR) {
  const auto g = geometry_of<Triangle>(ring_triangle);
  // u_r = 0.3 r + 0.7 z + 0.2; hoop strain u_r / r at each point.
  for (int q = 0; q < Triangle::points; ++q) {
    const auto p = Triangle::at(g, q);
    double gradient[3] = {}, hoop = 0, r = 0, z = 0;
    for (int a = 0; a < 3; ++a) {
      const double nodal = 0.3 * ring_triangle[a][0] + 0.7 * ring_triangle[a][2] + 0.2;
      for (int i = 0; i < 3; ++i) gradient[i] += p.vectors().gradient[a][i][0] * nodal;
      hoop += p.vectors().hoop[a][0] * nodal;
      r += p.vectors().value[a] * ring_triangle[a][0];
      z += p.vectors().value[a] * ring_triangle[a][2];
    }
    EXPECT_NEAR(gradient[0], 0.3, 1e-15);
    EXPECT_EQ(gradient[1], 0);
    EXPECT_NEAR(gradient[2], 0.7, 1e-15);
    EXPECT_NEAR(hoop, (0.3 * r + 0.7 * z + 0.2) / r, 1e-15);
  }
}

TEST(AxisymmetricTriangle, MetricIsTheIdentityInThePlaneOfTheRegularOneOfUnitEdge) {
  const Corners x{{{1, 0, 0}, {2, 0, 0}, {1.5, 0, std::sqrt(3.0) / 2}, {}}};
  const auto g = geometry_of<Triangle>(x);
  EXPECT_NEAR(g.metric(0, 0)[0], 1, 1e-15);
  EXPECT_NEAR(g.metric(2, 2)[0], 1, 1e-15);
  EXPECT_NEAR(g.metric(0, 2)[0], 0, 1e-15);
  EXPECT_EQ(g.metric(0, 1)[0], 0);
  EXPECT_EQ(g.metric(1, 2)[0], 0);
  EXPECT_NEAR(g.size_squared[0], 1, 1e-15);
  const auto turned = geometry_of<Triangle>({{x[1], x[2], x[0], {}}});
  EXPECT_NEAR(turned.metric(0, 0)[0], 1, 1e-14);
  EXPECT_NEAR(turned.metric(0, 2)[0], 0, 1e-15);
}

// The side from (1, 0) to (3, 1) sweeps a frustum of lateral area pi (1 + 3) sqrt(5), its outward normal to the right
// of the side; a closed polygon has no resultant along z.
TEST(AxisymmetricTriangleSide, SweepsItsArea) {
  using F = Triangle::Facet;
  const auto swept = [](double r0, double z0, double r1, double z1) {
    Vec3<Pack> x[2] = {{{Pack(r0), Pack(0.0), Pack(z0)}}, {{Pack(r1), Pack(0.0), Pack(z1)}}};
    std::array<double, 3> total{};
    for (int q = 0; q < F::points; ++q)
      for (int i = 0; i < 3; ++i) total[i] += F::weighted_normal(x, q)[i][0];
    return total;
  };
  const auto n = swept(1, 0, 3, 1);
  EXPECT_NEAR(std::hypot(n[0], n[2]), pi * 4 * std::sqrt(5.0), 1e-13);
  EXPECT_GT(n[0], 0);
  EXPECT_LT(n[2], 0);
  double along = 0;
  const double corner[4][2] = {{1, 0}, {3, 1}, {2, 4}, {1, 0}};
  for (int s = 0; s < 3; ++s) along += swept(corner[s][0], corner[s][1], corner[s + 1][0], corner[s + 1][1])[2];
  EXPECT_NEAR(along, 0, 1e-13);
}

// |u|^2/2 u . n of a linear velocity is cubic: the rule is exact. u = (x, y, 1 + x) through the unit triangle z = 0,
// and u = (r, 1) in (r, z) through the ring 1 < r < 2 whose normal points down.
TEST(KineticFlux, IsExactForLinearVelocities) {
  const std::vector<std::array<double, 3>> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<double> flow{0, 0, 1, 9, 1, 0, 2, 9, 0, 1, 1, 9};
  EXPECT_NEAR(kinetic_flux<Tet>(corners, std::vector<std::array<int, 3>>{{0, 1, 2}}, flow), 23.0 / 30, 1e-15);
  EXPECT_NEAR(kinetic_flux<Tet>(corners, std::vector<std::array<int, 3>>{{0, 2, 1}}, flow), -23.0 / 30, 1e-15);
  const std::vector<std::array<double, 3>> ends{{1, 0, 0}, {2, 0, 0}};
  EXPECT_NEAR(kinetic_flux<Triangle>(ends, std::vector<std::array<int, 2>>{{0, 1}}, {1, 1, 9, 2, 1, 9}), -5.25 * pi,
              1e-13);
}

}  // namespace

}  // namespace fsi::test
