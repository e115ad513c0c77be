// Pressures of Taylor-Hood elements beside which no free velocity is left.

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

#include "fem/elements.hpp"
#include "mesh/boundary.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesher/corner_cells.hpp"
#include "scene/pressure_equations.hpp"

namespace fsi::test {

namespace {

/// The velocity is given on the whole boundary. \param open  nodes where it is not
template <class Element>
std::optional<LostPressures> lost_in(const SimplexMesh<Element::dim, Element::order>& mesh,
                                     const std::vector<int>& open = {}, bool by_conditions = true) {
  const auto part = submesh(mesh, {0});
  DirichletConditions<Element::components> velocity(part.node_count());
  std::vector<int> given;
  for (const auto& facet : boundary_facets(mesh, {0}))
    for (const int node : facet.nodes) {
      if (std::find(open.begin(), open.end(), node) != open.end()) continue;
      if (by_conditions)
        velocity.fix(node);
      else
        given.push_back(node);
    }
  return lost_pressures<Element>(part, velocity, given);
}

/// A tetrahedron over one face of another: the upper vertex 4 has one cell, all edges of which are outside.
SimplexMesh<3, 2> two_tetrahedra() {
  TetrahedralMesh mesh;
  mesh.regions = {"fluid"};
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {0.3, 0.3, 1}};
  mesh.cells = {{0, 2, 1, 3}, {0, 1, 2, 4}};
  mesh.cell_region = {0, 0};
  return with_mid_edge_nodes(mesh);
}

TEST(PressureEquations, NoneIsLeftInACorner) {
  const auto mesh = two_tetrahedra();
  const auto lost = lost_in<P2P1Tetrahedron>(mesh);
  ASSERT_TRUE(lost);
  EXPECT_TRUE(lost->corner());
  EXPECT_EQ(lost->cells, 2);  // around vertex 0, the first: no node of either cell is free
  const auto again = lost_in<P2P1Tetrahedron>(mesh, {}, false);  // as an interface gives it
  ASSERT_TRUE(again);
  EXPECT_EQ(again->at, lost->at);
  const auto divided = divided_at_centres(mesh, corner_cells(mesh));
  EXPECT_FALSE(lost_in<P2P1Tetrahedron>(divided));
  // Under a pressure all round every velocity is free.
  std::vector<int> open(mesh.nodes.size());
  std::iota(open.begin(), open.end(), 0);
  EXPECT_FALSE(lost_in<P2P1Tetrahedron>(mesh, open));
  // Stabilised elements need none.
  EXPECT_FALSE(lost_in<P1Tetrahedron>(without_mid_edge_nodes(mesh)));
}

/// A square of two triangles: the middle of the diagonal has two free components, for four pressures. Each alone has them;
/// together they are too many. Of four triangles about a middle there are ten for five.
TEST(PressureEquations, AreCountedTogether) {
  TriangleMesh mesh;
  mesh.regions = {"fluid"};
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.cells = {{0, 1, 2}, {0, 2, 3}};
  mesh.cell_region = {0, 0};
  const auto lost = lost_in<P2P1PlaneTriangle>(with_mid_edge_nodes(mesh));
  ASSERT_TRUE(lost);
  EXPECT_FALSE(lost->corner());
  EXPECT_EQ(lost->velocities, 2);
  EXPECT_GT(lost->pressures, 2);
  EXPECT_EQ(lost->cells, 2);
  mesh.nodes.push_back({0.5, 0.5, 0});
  mesh.cells = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  mesh.cell_region = {0, 0, 0, 0};
  EXPECT_FALSE(lost_in<P2P1PlaneTriangle>(with_mid_edge_nodes(mesh)));
}

}  // namespace

}  // namespace fsi::test
