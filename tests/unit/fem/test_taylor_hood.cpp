// The quadratic tetrahedron and the nodes in the middles of edges: what function spaces of two orders rest on.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "fem/facet_load.hpp"
#include "fem/function_space.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "fem/p2p1_tetrahedron.hpp"
#include "mesh/boundary.hpp"
#include "support/meshes.hpp"
#include "support/nodal_arrays.hpp"

namespace fsi::test {

namespace {

using TaylorHood = P2P1Tetrahedron;
using QuadraticMesh = SimplexMesh<3, 2>;

TaylorHood::Geometry geometry_of(const QuadraticMesh& mesh, const QuadraticMesh::Cell& cell) {
  Vec3<Pack> x[TaylorHood::nodes];
  for (int a = 0; a < TaylorHood::nodes; ++a)
    for (int i = 0; i < 3; ++i) x[a][i] = Pack(mesh.nodes[cell[a]][i]);
  return TaylorHood::geometry(x);
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(MidEdgeNodes, StandInTheMiddleOfEachEdgeOnce) {
  const auto linear = irregular_cube(3);
  const auto mesh = with_mid_edge_nodes(linear);
  // Euler: vertices - edges + faces - cells = 1 for a ball; every cell has four faces, inner ones shared by two.
  const auto surface = boundary_facets(linear).size();
  const auto faces = (4 * linear.cells.size() + surface) / 2;
  const auto edges = linear.nodes.size() + faces - linear.cells.size() - 1;
  EXPECT_EQ(mesh.nodes.size(), linear.nodes.size() + edges);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    EXPECT_TRUE(std::equal(linear.cells[c].begin(), linear.cells[c].end(), mesh.cells[c].begin()));
    for (int e = 0; e < 6; ++e) {
      const auto& [a, b] = SimplexEdges<3>::vertices[e];
      for (int i = 0; i < 3; ++i)
        EXPECT_EQ(mesh.nodes[mesh.cells[c][4 + e]][i],
                  0.5 * (mesh.nodes[mesh.cells[c][a]][i] + mesh.nodes[mesh.cells[c][b]][i]));
    }
  }
}

TEST(TaylorHoodTetrahedron, ReproducesQuadraticVectorsAndLinearScalars) {
  const auto mesh = with_mid_edge_nodes(irregular_cube(2, 0.2));
  const auto f = [](const Point& x) { return 1 + x[0] - 2 * x[1] * x[2] + 3 * x[0] * x[0] - x[1] * x[0]; };
  const auto gradient = [](const Point& x) { return Point{1 + 6 * x[0] - x[1], -2 * x[2] - x[0], -2 * x[1]}; };
  for (const auto& cell : mesh.cells)
    for (int q = 0; q < TaylorHood::points; ++q) {
      const auto g = TaylorHood::at(geometry_of(mesh, cell), q);
      Point x{}, slope{}, linear_slope{};
      double value = 0, linear = 0;
      for (int a = 0; a < 10; ++a) {
        for (int i = 0; i < 3; ++i) x[i] += g.vectors().value[a] * mesh.nodes[cell[a]][i];
        value += g.vectors().value[a] * f(mesh.nodes[cell[a]]);
        for (int i = 0; i < 3; ++i) slope[i] += g.vectors().gradient[a][i][0] * f(mesh.nodes[cell[a]]);
      }
      for (int a = 0; a < 4; ++a) {
        linear += g.scalars().value[a] * mesh.nodes[cell[a]][1];
        for (int i = 0; i < 3; ++i) linear_slope[i] += g.scalars().gradient[a][i][0] * mesh.nodes[cell[a]][1];
      }
      EXPECT_NEAR(value, f(x), 1e-13);
      EXPECT_NEAR(linear, x[1], 1e-14);
      for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(slope[i], gradient(x)[i], 1e-12);
        EXPECT_NEAR(linear_slope[i], i == 1, 1e-13);
      }
    }
}

// Integrals of monomials over the unit tetrahedron: i! j! k! / (i + j + k + 3)!.
TEST(TaylorHoodTetrahedron, RuleIsExactForDegreeFive) {
  QuadraticMesh mesh = with_mid_edge_nodes(
      TetrahedralMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {0}, {"fluid"}, {}});
  const auto geometry = geometry_of(mesh, mesh.cells[0]);
  for (int i = 0; i <= 6; ++i)
    for (int j = 0; i + j <= 6; ++j)
      for (int k = 0; i + j + k <= 6; ++k) {
        double integral = 0;
        for (int q = 0; q < TaylorHood::points; ++q) {
          const auto& l = TaylorHood::rule.point[q];
          integral += TaylorHood::at(geometry, q).weight[0] * std::pow(l[1], i) * std::pow(l[2], j) * std::pow(l[3], k);
        }
        const double exact = std::tgamma(i + 1) * std::tgamma(j + 1) * std::tgamma(k + 1) / std::tgamma(i + j + k + 4);
        if (i + j + k <= 5) {
          EXPECT_NEAR(integral, exact, 1e-16) << i << j << k;
        } else if (i == 6) {
          EXPECT_GT(std::abs(integral - exact), 1e-6) << "the test sees an error of degree six";
        }
      }
}

// The integrals of the vertices' shape functions are negative in the volume and zero on faces: what is divided by, or
// has its root taken, must not be these.
TEST(FunctionSpace, OfTaylorHoodHasPositiveNodalVolumesAndAreas) {
  const auto linear = irregular_cube(3);
  auto mesh = with_mid_edge_nodes(linear);
  const auto part = whole(mesh);
  const auto volumes = nodal_volumes<TaylorHood>(part);
  EXPECT_GT(*std::min_element(volumes.begin(), volumes.end()), 0);
  EXPECT_NEAR(sum(volumes), 1, 1e-13);
  double vertex_integral = 0;
  for (int q = 0; q < TaylorHood::points; ++q)
    vertex_integral += TaylorHood::rule.weight[q] * TaylorHood::Shapes::shape(TaylorHood::rule.point[q], 0);
  EXPECT_NEAR(vertex_integral, -0.05, 1e-15) << "over the volume";

  TetrahedralMesh with_face = linear;
  with_face.facet_groups.push_back({"face", facets_where(linear, "fluid", [](const Point& x) { return x[2] == 0; })});
  mesh = with_mid_edge_nodes(with_face);
  const auto& face = *mesh.facets("face");
  const auto areas = nodal_areas<TaylorHood>(mesh.nodes, face);
  const auto weights = scalar_weights<TaylorHood>(mesh.nodes, face);
  const auto normals = normal_weights<TaylorHood, MixedLayout<3>>(mesh.nodes, face);
  EXPECT_NEAR(sum(areas), 1, 1e-13);
  EXPECT_NEAR(sum(weights), 1, 1e-13);
  double through = 0;
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    const bool on = std::abs(mesh.nodes[a][2]) < 1e-12;
    EXPECT_EQ(areas[a] > 0, on);
    EXPECT_EQ(weights[a] > 0, on && a < linear.nodes.size()) << "pressures live at vertices";
    through += normals[MixedLayout<3>::vector(static_cast<int>(a), 2)];
  }
  EXPECT_NEAR(through, -1, 1e-13);
}

TEST(FunctionSpace, KnowsWhichNodesCarryScalars) {
  const auto linear = irregular_cube(2);
  const auto mesh = with_mid_edge_nodes(linear);
  const auto space = function_space<TaylorHood>(whole(mesh));
  int scalars = 0;
  for (int a = 0; a < space.node_count(); ++a) scalars += space.carries_scalar(a);
  EXPECT_EQ(scalars, static_cast<int>(linear.nodes.size()));
  EXPECT_EQ(space.node_count(), static_cast<int>(mesh.nodes.size()));
  const auto equal_order = function_space<P1Tetrahedron>(whole(linear));
  for (int a = 0; a < equal_order.node_count(); ++a) EXPECT_TRUE(equal_order.carries_scalar(a));
}

}  // namespace

}  // namespace fsi::test
