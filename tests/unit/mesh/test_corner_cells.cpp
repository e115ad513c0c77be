// Cells in corners, whose pressure Taylor-Hood leaves without an equation, and what they are divided into.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mesh/curved_cells.hpp"
#include "mesh/facets.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesh/point_math.hpp"
#include "mesher/corner_cells.hpp"

namespace fsi::test {

namespace {

/// A cube of side 2 whose eight corners are cut off, a tetrahedron each, and the rest divided from its centre: every corner's
/// vertex belongs to one cell, all edges of which lie on the cube's sides.
TetrahedralMesh cut_cube() {
  TetrahedralMesh mesh;
  mesh.regions = {"fluid"};
  const auto corner = [](int i) { return Point{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0}; };
  for (int i = 0; i < 8; ++i) mesh.nodes.push_back(corner(i));
  const auto middle = [&](int a, int b) {
    const Point x = 0.5 * (mesh.nodes[a] + mesh.nodes[b]);
    for (std::size_t n = 8; n < mesh.nodes.size(); ++n)
      if (distance(mesh.nodes[n], x) < 1e-12) return static_cast<int>(n);
    mesh.nodes.push_back(x);
    return static_cast<int>(mesh.nodes.size()) - 1;
  };
  std::vector<std::array<int, 3>> inner;  // faces of what is left, to be joined with the centre
  for (int i = 0; i < 8; ++i) {
    const int x = middle(i, i ^ 1), y = middle(i, i ^ 2), z = middle(i, i ^ 4);
    mesh.cells.push_back({i, x, y, z});
    inner.push_back({x, y, z});
  }
  for (const int axis : {1, 2, 4})  // the squares left on the sides, each halved
    for (const int side : {0, axis}) {
      const int u = axis == 1 ? 2 : 1, v = axis == 4 ? 2 : 4;
      const int a = middle(side, side | u), b = middle(side | u, side | u | v), c = middle(side | v, side | u | v),
                d = middle(side, side | v);
      inner.push_back({a, b, c});
      inner.push_back({a, c, d});
    }
  const int centre = static_cast<int>(mesh.nodes.size());
  mesh.nodes.push_back({0, 0, 0});
  for (const auto& [a, b, c] : inner) mesh.cells.push_back({centre, a, b, c});
  for (auto& cell : mesh.cells)
    if (tetrahedron_volume(mesh.nodes[cell[0]], mesh.nodes[cell[1]], mesh.nodes[cell[2]], mesh.nodes[cell[3]]) < 0)
      std::swap(cell[2], cell[3]);
  mesh.cell_region.assign(mesh.cells.size(), 0);
  return mesh;
}

template <int Dim, int Order>
double volume_of(const SimplexMesh<Dim, Order>& mesh) {
  double volume = 0;
  for (const auto& cell : mesh.cells) {
    std::array<Point, Dim + 1> x;
    for (int a = 0; a <= Dim; ++a) x[a] = mesh.nodes[cell[a]];
    const double part = simplex_volume<Dim>(x.data());
    EXPECT_GT(part, 0);
    volume += part;
  }
  return volume;
}

TEST(CornerCells, AreFoundAndDividedInFour) {
  const TetrahedralMesh mesh = cut_cube();
  ASSERT_NEAR(volume_of(mesh), 8, 1e-12);
  EXPECT_EQ(corner_cells(mesh), (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}));
  const TetrahedralMesh divided = divided_at_centres(mesh, corner_cells(mesh));
  EXPECT_EQ(divided.cells.size(), mesh.cells.size() + 8 * 3);
  EXPECT_EQ(divided.nodes.size(), mesh.nodes.size() + 8);
  EXPECT_NEAR(volume_of(divided), 8, 1e-12);
  EXPECT_TRUE(corner_cells(divided).empty());
}

TEST(CornerCells, OfOtherVolumesAndAtPlanesOfSymmetryAreLeft) {
  TetrahedralMesh mesh = cut_cube();
  // The side x = -1 is a mirror: edges that lie on it alone are free along it.
  TetrahedralMesh::FacetGroup mirror{"symmetry_x", {}};
  for (const auto& cell : mesh.cells)
    for (const auto& facet : outward_facets<3, 1>(cell))
      if (std::all_of(facet.begin(), facet.end(), [&](int node) { return mesh.nodes[node][0] == -1; }))
        mirror.facets.push_back(facet);
  ASSERT_EQ(mirror.facets.size(), 6u);
  mesh.facet_groups.push_back(mirror);
  EXPECT_EQ(corner_cells(mesh), (std::vector<int>{1, 3, 5, 7}));
  mesh.regions = {"media"};
  EXPECT_TRUE(corner_cells(mesh).empty());
}

/// Of a curved cell the parts fill the cell: every node of theirs lies where the whole cell's shape functions put it, and no
/// Jacobian turns negative. Sides keep their nodes.
TEST(CornerCells, OfSecondOrderKeepTheirCurvedSides) {
  auto mesh = with_mid_edge_nodes(cut_cube());
  for (Point& x : mesh.nodes) x = x + Point{0.05 * x[1] * x[1], 0.04 * x[2] * x[0], 0.03 * x[0] * x[1]};  // quadratic
  const auto corners = corner_cells(mesh);
  ASSERT_EQ(corners.size(), 8u);
  const auto divided = divided_at_centres(mesh, corners);
  EXPECT_TRUE(corner_cells(divided).empty());
  EXPECT_EQ(divided.nodes.size(), mesh.nodes.size() + 8 * 5);
  // The map is quadratic and the cut linear, so the nodes of the divided straight cube go where the map takes them.
  const auto straight = divided_at_centres(with_mid_edge_nodes(cut_cube()), corners);
  ASSERT_EQ(straight.cells, divided.cells);
  for (std::size_t n = 0; n < straight.nodes.size(); ++n) {
    const Point x = straight.nodes[n];
    const Point there = x + Point{0.05 * x[1] * x[1], 0.04 * x[2] * x[0], 0.03 * x[0] * x[1]};
    EXPECT_LT(distance(there, divided.nodes[n]), 1e-14) << n;
  }
  for (const auto& cell : divided.cells) {
    std::array<Point, 10> x;
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = divided.nodes[cell[k]];
    EXPECT_TRUE(cell_jacobian<3>(x).positive);
  }
}

/// One triangle alone is all corner; beside another one it is none.
TEST(CornerCells, OfTriangles) {
  TriangleMesh mesh;
  mesh.regions = {"fluid"};
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.cells = {{0, 1, 2}};
  mesh.cell_region = {0};
  mesh.nodes.pop_back();
  EXPECT_EQ(corner_cells(mesh), std::vector<int>{0});
  EXPECT_NEAR(volume_of(divided_at_centres(mesh, {0})), 0.5, 1e-15);
  EXPECT_TRUE(corner_cells(divided_at_centres(mesh, {0})).empty());
  mesh.nodes.push_back({1, 1, 0});
  mesh.cells.push_back({1, 3, 2});
  mesh.cell_region.push_back(0);
  EXPECT_TRUE(corner_cells(mesh).empty());
}

}  // namespace

}  // namespace fsi::test
