// Uniform refinement: what must stay (shape, groups, orientation, conformity) and how far quality may fall.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/error.hpp"
#include "mesh/boundary.hpp"
#include "mesh/curved_cells.hpp"
#include "mesh/facet_uses.hpp"
#include "mesh/facets.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesh/point_math.hpp"
#include "mesh/quality.hpp"
#include "mesher/artery/curved_edges.hpp"
#include "mesher/uniform_refinement.hpp"
#include "meshes.hpp"
#include "support/random.hpp"

namespace fsi {
namespace {

TriangleMesh section() {
  ArteryCells cells;
  cells.axial = 3;
  return generate_artery_section(ArteryShape(), cells);
}

/// Length or area of a straight facet.
template <int Dim, std::size_t Nodes>
double facet_measure(const std::vector<Point>& nodes, const std::array<int, Nodes>& facet) {
  if constexpr (Dim == 2) return distance(nodes[facet[0]], nodes[facet[1]]);
  return norm(triangle_area_vector(nodes[facet[0]], nodes[facet[1]], nodes[facet[2]]));
}

/// Groups have 2^(Dim-1) times the facets, all of them facets of a cell, looking out of it as those of the mesh do.
template <int Dim, int Order>
void expect_facets_of_cells(const SimplexMesh<Dim, Order>& mesh, const SimplexMesh<Dim, Order>& fine) {
  std::set<typename SimplexMesh<Dim, Order>::Facet> of_cells;
  for (const auto& cell : fine.cells)
    for (const auto& facet : outward_facets<Dim, Order>(cell)) {
      auto turned = facet;  // a face may begin at any of its vertices
      for (int i = 0; i < Dim; ++i) {
        of_cells.insert(turned);
        if (Dim == 2) break;
        std::rotate(turned.begin(), turned.begin() + 1, turned.begin() + Dim);
        if (Order == 2) std::rotate(turned.begin() + Dim, turned.begin() + Dim + 1, turned.end());
      }
    }
  ASSERT_EQ(fine.facet_groups.size(), mesh.facet_groups.size());
  for (std::size_t g = 0; g < mesh.facet_groups.size(); ++g) {
    const auto &before = mesh.facet_groups[g], &after = fine.facet_groups[g];
    EXPECT_EQ(after.name, before.name);
    ASSERT_EQ(after.facets.size(), before.facets.size() << (Dim - 1));
    double area_before = 0, area_after = 0;
    for (const auto& facet : before.facets) area_before += facet_measure<Dim>(mesh.nodes, facet);
    for (const auto& facet : after.facets) {
      EXPECT_EQ(of_cells.count(facet), 1u) << after.name;
      area_after += facet_measure<Dim>(fine.nodes, facet);
    }
    if constexpr (Order == 1) {
      EXPECT_NEAR(area_after, area_before, 1e-12 * area_before) << after.name;
    }
  }
}

/// Conforming, of the same shape, with the same regions and groups.
template <int Dim, int Order>
void expect_the_same_shape(const SimplexMesh<Dim, Order>& mesh, int times) {
  const auto fine = refine_uniformly(mesh, times, "test");
  const auto counts = refined_counts(mesh, times);
  EXPECT_EQ(static_cast<double>(fine.nodes.size()), counts.nodes);
  EXPECT_EQ(static_cast<double>(fine.cells.size()), counts.cells);
  EXPECT_TRUE(std::equal(mesh.nodes.begin(), mesh.nodes.end(), fine.nodes.begin()));
  const std::set<Point> places(fine.nodes.begin(), fine.nodes.end());
  EXPECT_EQ(places.size(), fine.nodes.size()) << "a node was made twice";

  std::map<FacetKey<Dim>, int> users;
  for (const auto& use : sorted_facet_uses(fine)) ++users[use.key];
  std::size_t outside = 0, expected = 0;
  for (const auto& [key, count] : users) {
    EXPECT_LE(count, 2);
    outside += count == 1;
  }
  users.clear();
  for (const auto& use : sorted_facet_uses(mesh)) ++users[use.key];
  for (const auto& [key, count] : users) expected += count == 1;
  EXPECT_EQ(outside, expected << (times * (Dim - 1)));

  const auto before = measure_quality(mesh), after = measure_quality(fine);
  EXPECT_EQ(fine.regions, mesh.regions);
  for (std::size_t r = 0; r < before.regions.size(); ++r) {
    EXPECT_NEAR(after.regions[r].volume, before.regions[r].volume, 1e-12 * before.regions[r].volume);
    EXPECT_EQ(after.regions[r].cells, before.regions[r].cells << (times * Dim));
  }
  EXPECT_GT(after.min_eta, 0);
  EXPECT_GE(after.min_jacobian, before.min_jacobian - 0.01);  // found to within 1 %
  if (times == 1) expect_facets_of_cells(mesh, fine);
}

TEST(UniformRefinement, KeepsShapeAndGroups) {
  for (const int times : {1, 2}) {
    SCOPED_TRACE(times);
    expect_the_same_shape(section(), times);
    expect_the_same_shape(with_mid_edge_nodes(section()), times);
    expect_the_same_shape(test::short_artery(), times);
  }
  expect_the_same_shape(with_curved_edges(test::short_artery(), 1.43), 1);
}

TEST(UniformRefinement, TrianglesStayAlike) {
  const auto before = measure_quality(section());
  const auto after = measure_quality(refine_uniformly(section(), 3, "test"));
  EXPECT_NEAR(after.min_eta, before.min_eta, 1e-9);
  EXPECT_NEAR(after.mean_eta, before.mean_eta, 1e-12);
}

TetrahedralMesh one_tetrahedron(const std::array<Point, 4>& corners) {
  TetrahedralMesh mesh;
  mesh.nodes.assign(corners.begin(), corners.end());
  mesh.cells = {{0, 1, 2, 3}};
  mesh.cell_region = {0};
  mesh.regions = {"fluid"};
  return mesh;
}

/// Mean ratios of all cells, each value once.
std::vector<double> different_mean_ratios(const TetrahedralMesh& mesh) {
  std::vector<double> all;
  for (const auto& cell : mesh.cells) {
    std::array<Point, 4> x;
    for (int i = 0; i < 4; ++i) x[i] = mesh.nodes[cell[i]];
    all.push_back(mean_ratio(x));
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end(), [](double a, double b) { return b - a < 1e-9; }), all.end());
  return all;
}

TEST(UniformRefinement, OfARegularTetrahedronHasTwoShapes) {
  // Those around the diagonal have five edges of 1/2 and one of sqrt(1/2): (6/4) / (5/4 + 1/2) = 6/7.
  const auto found = different_mean_ratios(
      refine_uniformly(one_tetrahedron({{{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}}}), 3, "test"));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0], 6.0 / 7, 1e-12);
  EXPECT_NEAR(found[1], 1, 1e-12);
}

TEST(UniformRefinement, AnyTetrahedronHasThreeShapesNoneBelowTheBound) {
  test::Random random(3);
  double least = 1;
  int tried = 0;
  while (tried < 300) {
    std::array<Point, 4> corners;
    for (auto& x : corners)
      for (double& coordinate : x) coordinate = random();
    corners[3][2] *= tried % 3 == 0 ? 0.05 : 1;  // flat ones, too
    const double eta = mean_ratio(corners);
    if (eta < 0.01) continue;
    ++tried;
    const auto found = different_mean_ratios(refine_uniformly(one_tetrahedron(corners), 3, "test"));
    EXPECT_LE(found.size(), 3u);
    least = std::min(least, found.front() / eta);
  }
  EXPECT_GE(least, least_child_ratio);
  EXPECT_LT(least, 0.80);  // the bound is no exaggeration
}

TEST(UniformRefinement, NewNodesLieOnTheCurve) {
  // Its edge from (0,0) to (1,0) is the parabola y = -x (1 - x), which a quadratic edge is exactly.
  SimplexMesh<2, 2> mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, -0.25, 0}, {0.5, 0.5, 0}, {0, 0.5, 0}};
  mesh.cells = {{0, 1, 2, 3, 4, 5}};
  mesh.cell_region = {0};
  mesh.regions = {"fluid"};
  mesh.facet_groups = {{"curved", {{0, 1, 3}}}, {"straight", {{1, 2, 4}}}};
  const auto fine = refine_uniformly(mesh, 3, "test");
  ASSERT_EQ(fine.facets("curved")->size(), 8u);
  for (const auto& facet : *fine.facets("curved")) {
    for (const int node : facet) {
      const Point& x = fine.nodes[node];
      EXPECT_NEAR(x[1], -x[0] * (1 - x[0]), 1e-15);
    }
    EXPECT_NEAR(fine.nodes[facet[2]][0], 0.5 * (fine.nodes[facet[0]][0] + fine.nodes[facet[1]][0]), 1e-15);
  }
  for (const auto& facet : *fine.facets("straight"))
    for (const int node : facet) EXPECT_NEAR(fine.nodes[node][0] + fine.nodes[node][1], 1, 1e-15);
  EXPECT_NEAR(measure_quality(fine).regions[0].volume, 0.5 + 1.0 / 6, 1e-14);  // between chord and parabola: 1/6
}

TEST(UniformRefinement, StraightCellsOfACurvedMeshTendToIt) {
  // Volume and surface of the straight cells between the vertices: errors of second order.
  const auto curved = with_curved_edges(test::short_artery(), 1.43);
  const double volume = measure_quality(curved).regions[0].volume;
  std::vector<double> errors, areas;
  for (int times = 0; times <= 2; ++times) {
    const auto straight = without_mid_edge_nodes(times == 0 ? curved : refine_uniformly(curved, times, "test"));
    errors.push_back(volume - measure_quality(straight).regions[0].volume);
    double area = 0;
    for (const auto& facet : *straight.facets("outer")) area += facet_measure<3>(straight.nodes, facet);
    areas.push_back(area);
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.05);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.05);
  EXPECT_NEAR(std::log2((areas[1] - areas[0]) / (areas[2] - areas[1])), 2, 0.1);
}

TEST(UniformRefinement, RefusesAChildThatIsInsideOut) {
  SimplexMesh<2, 2> mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0.6, 0}, {0.5, 0.5, 0}, {0, 0.5, 0}};
  mesh.cells = {{0, 1, 2, 3, 4, 5}};
  mesh.cell_region = {0};
  mesh.regions = {"fluid"};
  try {
    refine_uniformly(mesh, 1, "folded.msh");
    FAIL();
  } catch (const InputError& error) {
    const std::string said = error.what();
    EXPECT_EQ(said.find("folded.msh: triangle near ("), 0u) << said;
    EXPECT_NE(said.find("a part of it would be inverted, area -0.0"), std::string::npos) << said;
  }
}

TEST(UniformRefinement, RefusesWhatCannotBeNumbered) {
  EXPECT_THROW(refine_uniformly(test::short_artery(), 9, "test"), InputError);
}

}  // namespace
}  // namespace fsi
