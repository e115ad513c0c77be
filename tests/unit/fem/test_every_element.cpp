// What every element promises: shape functions, rules that are exact to their degree and no further, geometry of curved
// edges, facets that close, fibre directions.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fem/contributions.hpp"
#include "fem/elements.hpp"
#include "fem/facet_load.hpp"
#include "fem/function_space.hpp"
#include "mesh/facets.hpp"
#include "support/element_meshes.hpp"
#include "support/pi.hpp"
#include "wall/fibre_directions.hpp"

namespace fsi::test {

namespace {

double factorial(int n) {
  return std::tgamma(n + 1.0);
}

/// Mean over a simplex of l_0^i l_1^j l_2^k l_3^m: d! i! j! k! m! / (i + j + k + m + d)!.
double mean_of_monomial(const std::vector<int>& power) {
  const int d = static_cast<int>(power.size()) - 1;
  double value = factorial(d);
  int degree = d;
  for (int p : power) {
    value *= factorial(p);
    degree += p;
  }
  return value / factorial(degree);
}

/// The largest error of a rule for monomials of a degree.
template <int Vertices, int Points>
double rule_error(const SimplexRule<Vertices, Points>& rule, int degree) {
  double worst = 0;
  std::vector<int> power(Vertices, 0);
  const auto over = [&](const auto& self, int vertex, int left) -> void {
    if (vertex + 1 < Vertices) {
      for (power[vertex] = 0; power[vertex] <= left; ++power[vertex]) self(self, vertex + 1, left - power[vertex]);
      return;
    }
    power[vertex] = left;
    double sum = 0;
    for (int q = 0; q < Points; ++q) {
      double value = rule.weight[q];
      for (int v = 0; v < Vertices; ++v) value *= std::pow(rule.point[q][v], power[v]);
      sum += value;
    }
    worst = std::max(worst, std::abs(sum - mean_of_monomial(power)));
  };
  over(over, 0, degree);
  return worst;
}

template <int Vertices, int Points>
void expect_degree(const SimplexRule<Vertices, Points>& rule, int degree) {
  for (int k = 0; k <= degree; ++k) EXPECT_LT(rule_error(rule, k), 3e-16) << Points << " points, degree " << k;
  EXPECT_GT(rule_error(rule, degree + 1), 1e-6) << Points << " points: the test must see an error";
  for (int q = 0; q < Points; ++q) {
    EXPECT_GT(rule.weight[q], 0);
    for (double l : rule.point[q]) EXPECT_TRUE(l > 0 && l < 1) << "inside: off the axis of a body of revolution";
  }
}

TEST(SimplexRules, AreExactToTheirDegreeAndNoFurther) {
  expect_degree(line_rule_3(), 3);
  expect_degree(line_rule_5(), 5);
  expect_degree(line_rule_7(), 7);
  expect_degree(triangle_rule_2(), 2);
  expect_degree(triangle_rule_4(), 4);
  expect_degree(triangle_rule_5(), 5);
  expect_degree(triangle_rule_6(), 6);
  expect_degree(tetrahedron_rule_5(), 5);
}

template <class Element>
class EveryElement : public testing::Test {
 protected:
  /// One that is not regular, with curved edges where they can be; off the axis.
  static auto geometry(double curved, std::array<Point, Element::nodes>& x) {
    auto mesh = irregular_mesh<Element>(1);
    curve<Element>(mesh, curved);
    Vec3<Pack> nodes[Element::nodes];
    for (int a = 0; a < Element::nodes; ++a) {
      x[a] = mesh.nodes[mesh.cells[0][a]];
      for (int i = 0; i < 3; ++i) nodes[a][i] = Pack(x[a][i]);
    }
    return Element::geometry(nodes);
  }
};
using Elements = testing::Types<P1Tetrahedron, P1AxisymmetricTriangle, P1PlaneTriangle, P2P1Tetrahedron,
                                P2P1AxisymmetricTriangle, P2P1PlaneTriangle>;
TYPED_TEST_SUITE(EveryElement, Elements);

TYPED_TEST(EveryElement, InterpolatesPolynomialsOfItsOrderWithTheirGradients) {
  using Element = TypeParam;
  std::array<Point, Element::nodes> x;
  const auto geometry = this->geometry(0, x);
  constexpr int first = Element::axis[0], second = Element::axis[1], last = Element::axis[Element::dim - 1];
  const double bend = Element::order == 2 ? 1 : 0;
  const auto f = [&](const Point& at) {
    return 1 + at[first] - 2 * at[second] + 0.5 * at[last] +
           bend * (at[first] * at[last] - 3 * at[second] * at[second]);
  };
  const auto gradient = [&](const Point& at) {
    Point g{};
    g[first] += 1 + bend * at[last];
    g[second] += -2 - bend * 6 * at[second];
    g[last] += 0.5 + bend * at[first];
    return g;
  };
  for (int q = 0; q < Element::points; ++q) {
    const auto g = Element::at(geometry, q);
    Point at{}, slope{}, linear_slope{};
    double value = 0, linear = 0, hoop = 0;
    for (int a = 0; a < Element::nodes; ++a) {
      for (int i = 0; i < 3; ++i) at[i] += g.vectors().value[a] * x[a][i];
      for (int i = 0; i < 3; ++i) slope[i] += g.vectors().gradient[a][i][0] * f(x[a]);
      value += g.vectors().value[a] * f(x[a]);
      if constexpr (Element::axisymmetric) hoop += g.vectors().hoop[a][0] * f(x[a]);
    }
    for (int a = 0; a < Element::scalar_nodes; ++a) {
      linear += g.scalars().value[a] * x[a][second];
      for (int i = 0; i < 3; ++i) linear_slope[i] += g.scalars().gradient[a][i][0] * x[a][second];
    }
    EXPECT_NEAR(value, f(at), 1e-14);
    EXPECT_NEAR(linear, at[second], 1e-15);
    if constexpr (Element::axisymmetric) {
      EXPECT_NEAR(hoop, f(at) / at[0], 1e-14);
    }
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(slope[i], gradient(at)[i], 1e-13);
      EXPECT_NEAR(linear_slope[i], i == second, 1e-14);
    }
  }
}

// Gradients by way of the vertices are those of the shape functions, and what is summed up for test gradients goes to the rows
// that it would go to point by point.
TYPED_TEST(EveryElement, GradientsByTheVerticesAreThoseOfItsShapeFunctions) {
  using Element = TypeParam;
  if constexpr (Element::order == 2)
    for (const double curved : {0.0, 0.1}) {
      std::array<Point, Element::nodes> x;
      const auto geometry = this->geometry(curved, x);
      NodalVector<Element> u;
      for (int a = 0; a < Element::nodes; ++a)
        for (int k = 0; k < Element::components; ++k) u.at[a][k] = Pack(std::sin(3.0 * a + k));
      const FieldGradients<Element> gradients(u);
      ElementRows<Element, Pack> by_points, by_vertices;
      by_points.set_zero();
      by_vertices.set_zero();
      FluxSums<Element> sums;
      double size = 0;
      for (int q = 0; q < Element::points; ++q) {
        const auto g = Element::at(geometry, q);
        const Mat3<Pack> exact = gradient_of(u, g), h = gradient_of(gradients, g);
        Integrand<Pack> f{};
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) {
            size = std::max(size, std::abs(exact(i, j)[0]));
            EXPECT_NEAR(h(i, j)[0], exact(i, j)[0], 1e-13 * (1 + size)) << i << j;
            f.flux(i, j) = Pack(std::cos(5.0 * q + 3 * i + j));
          }
        by_points.add_fluxes(f, g, g.weight);
        sums.add(f.flux, g, g.weight);
        by_vertices.add_hoop_flux(f, g, g.weight);
      }
      EXPECT_GT(size, 1);
      sums.add_to(by_vertices.at);
      for (int a = 0; a < Element::nodes; ++a)
        for (int k = 0; k < Element::components; ++k)
          EXPECT_NEAR(by_vertices.at[a][k][0], by_points.at[a][k][0], 1e-13) << a << " " << k;
    }
}

// Gauss's theorem over one cell, for the field (first coordinate, 0, 0), in a body of revolution with u_r / r: the
// volume twice over. Weights, gradients, hoop terms, facets and their orientation must agree, curved edges included.
TYPED_TEST(EveryElement, VolumeIsTheFlowThroughItsFacets) {
  using Element = TypeParam;
  constexpr int dim = Element::dim;
  for (const double curved : {0.0, 0.1}) {
    std::array<Point, Element::nodes> x;
    const auto geometry = this->geometry(curved, x);
    double divergence = 0, volume = 0;
    for (int q = 0; q < Element::points; ++q) {
      const auto g = Element::at(geometry, q);
      volume += g.weight[0];
      for (int a = 0; a < Element::nodes; ++a) {
        divergence += (g.weight * g.vectors().gradient[a][0])[0] * x[a][0];
        if constexpr (Element::axisymmetric) divergence += (g.weight * g.vectors().hoop[a])[0] * x[a][0];
      }
    }
    typename SimplexMesh<dim, Element::order>::Cell cell;
    for (int a = 0; a < Element::nodes; ++a) cell[a] = a;
    std::vector<Point> nodes(x.begin(), x.end());
    double flow = 0;
    using Facet = typename Element::Facet;
    for (const auto& facet : outward_facets<dim, Element::order>(cell)) {
      Vec3<Pack> corner[Facet::nodes];
      facet_corners<Facet>(nodes, facet, corner);
      for (int q = 0; q < Facet::points; ++q) {
        const auto normal = Facet::weighted_normal(corner, q);
        for (int a = 0; a < Facet::nodes; ++a) flow += Facet::shape(q, a) * x[facet[a]][0] * normal[0][0];
      }
    }
    EXPECT_GT(volume, 0);
    EXPECT_NEAR(divergence, (Element::axisymmetric ? 2 : 1) * volume, 1e-13);
    EXPECT_NEAR(flow, divergence, 1e-13);
  }
}

// A ring of straight edges has the volume of Pappus; a cylinder's, with an edge on the axis, that of the book.
TEST(BodiesOfRevolution, HaveTheirVolumeAlsoAtTheAxis) {
  const auto volume = [](auto element, double inner) {
    using Element = decltype(element);
    const auto mesh = irregular_mesh<Element>(3, "fluid", inner);
    double sum = 0;
    for (const auto& cell : mesh.cells) {
      Vec3<Pack> x[Element::nodes];
      for (int a = 0; a < Element::nodes; ++a)
        for (int i = 0; i < 3; ++i) x[a][i] = Pack(mesh.nodes[cell[a]][i]);
      const auto geometry = Element::geometry(x);
      for (int q = 0; q < Element::points; ++q) {
        const auto g = Element::at(geometry, q);
        sum += g.weight[0];
        for (int a = 0; a < Element::nodes; ++a) EXPECT_TRUE(std::isfinite(g.vectors().hoop[a][0]));
      }
    }
    return sum;
  };
  EXPECT_NEAR(volume(P1AxisymmetricTriangle{}, 0), pi, 1e-13);
  EXPECT_NEAR(volume(P2P1AxisymmetricTriangle{}, 0), pi, 1e-13);
  EXPECT_NEAR(volume(P1AxisymmetricTriangle{}, 1), 3 * pi, 1e-13);
  EXPECT_NEAR(volume(P2P1AxisymmetricTriangle{}, 1), 3 * pi, 1e-13);
}

template <class Element>
FibreField<Element> fibres_of(const SimplexMesh<2, Element::order>& mesh, const CylinderAxis& axis, double angle) {
  const auto part = whole(mesh);
  const auto space = function_space<Element>(part);
  const ElementPacks<Element> packs(part.nodes, part.cells, all_cells(part), *space.graph());
  return fibre_directions(packs, part.nodes, part.cells, axis, angle);
}

// Mirror images of each other in the plane of the coordinates, the same at all points, whatever axis is given.
TEST(Fibres, OfABodyOfRevolutionAreConstant) {
  const double angle = 0.5;
  const auto fibres = fibres_of<P2P1AxisymmetricTriangle>(irregular_mesh<P2P1AxisymmetricTriangle>(2),
                                                          {{{3, 4, 5}}, {{1, 0, 0}}}, angle);
  for (const auto& pack : fibres[0])
    for (const auto& point : pack)
      for (int family = 0; family < 2; ++family) {
        EXPECT_EQ(point.direction[family][0][0], 0);
        EXPECT_NEAR(point.direction[family][1][0], std::cos(angle), 1e-15);
        EXPECT_NEAR(point.direction[family][2][0], (family == 0 ? 1 : -1) * std::sin(angle), 1e-15);
      }
}

// About an axis upright on the plane: the projection is along the circumference and has the length cos(angle).
TEST(Fibres, OfAPlaneTurnAboutTheAxis) {
  using Element = P2P1PlaneTriangle;
  const double angle = 0.5;
  auto mesh = irregular_mesh<Element>(1);
  curve<Element>(mesh, 0.1);
  const auto fibres = fibres_of<Element>(mesh, {{{-1, -2, 0}}, {{0, 0, 1}}}, angle);
  for (int q = 0; q < Element::points; ++q) {
    double x = 1, y = 2;
    for (int a = 0; a < Element::nodes; ++a) {
      const double shape = Element::Shapes::shape(Element::rule.point[q], a);
      x += shape * mesh.nodes[mesh.cells[0][a]][0];
      y += shape * mesh.nodes[mesh.cells[0][a]][1];
    }
    const double r = std::hypot(x, y);
    for (int family = 0; family < 2; ++family) {
      const auto& a = fibres[0][0][q].direction[family];
      EXPECT_NEAR(a[0][0], -std::cos(angle) * y / r, 1e-15);
      EXPECT_NEAR(a[1][0], std::cos(angle) * x / r, 1e-15);
      EXPECT_NEAR(a[2][0], (family == 0 ? 1 : -1) * std::sin(angle), 1e-15);
    }
  }
}

}  // namespace

}  // namespace fsi::test
