// Bisection of the cells of largest weight: what must stay, where cells become small, and how far quality falls.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/error.hpp"
#include "mesh/boundary.hpp"
#include "mesh/facet_uses.hpp"
#include "mesh/facets.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesh/point_math.hpp"
#include "mesh/quality.hpp"
#include "mesher/artery/curved_edges.hpp"
#include "mesher/bisection.hpp"
#include "meshes.hpp"
#include "support/random.hpp"

namespace fsi {
namespace {

TriangleMesh section() {
  ArteryCells cells;
  cells.axial = 3;
  return generate_artery_section(ArteryShape(), cells);
}

/// Weights that are large near a place inside the lumen's end.
template <int Dim, int Order>
BisectionPlan towards(const SimplexMesh<Dim, Order>& mesh, const Point& place, std::size_t most_nodes) {
  BisectionPlan plan;
  for (const auto& cell : mesh.cells) {
    Point centre{0, 0, 0};
    for (int i = 0; i <= Dim; ++i) centre = centre + (1.0 / (Dim + 1)) * mesh.nodes[cell[i]];
    plan.weights.push_back(std::exp(-2 * distance(centre, place)));
  }
  plan.shrinkage = 0.3;
  plan.most_nodes = most_nodes;
  return plan;
}

template <int Dim, int Order>
double facet_measure(const SimplexMesh<Dim, Order>& mesh, const typename SimplexMesh<Dim, Order>::Facet& f) {
  const auto& x = mesh.nodes;
  if constexpr (Dim == 2)
    return distance(x[f[0]], x[f[1]]);
  else
    return norm(triangle_area_vector(x[f[0]], x[f[1]], x[f[2]]));
}

/// Conforming, of the same shape and groups; facets are those of cells, as they look out of them.
template <int Dim, int Order>
SimplexMesh<Dim, Order> expect_the_same_shape(const SimplexMesh<Dim, Order>& mesh, std::size_t more) {
  const std::size_t most = mesh.nodes.size() + more;
  auto fine = bisect(mesh, towards(mesh, {0.3, 0, 0.2}, most), "test");
  EXPECT_GE(fine.nodes.size(), most);
  EXPECT_LE(fine.nodes.size(), most + 60);  // what one halving, with all around its edge, makes at the most here
  EXPECT_TRUE(std::equal(mesh.nodes.begin(), mesh.nodes.end(), fine.nodes.begin()));
  EXPECT_EQ(std::set<Point>(fine.nodes.begin(), fine.nodes.end()).size(), fine.nodes.size()) << "a node made twice";

  const auto count_outside = [](const auto& of) {
    std::map<FacetKey<Dim>, int> users;
    for (const auto& use : sorted_facet_uses(of)) ++users[use.key];
    double area = 0;
    for (const auto& facet : boundary_facets(of)) area += facet_measure(of, facet.nodes);
    for (const auto& [key, count] : users) EXPECT_LE(count, 2);
    return area;
  };
  const double area = count_outside(mesh);
  if (Order == 1) {
    EXPECT_NEAR(count_outside(fine), area, 1e-12 * area) << "a hanging node opens a gap";
  } else {
    EXPECT_NEAR(count_outside(fine), area, 0.05 * area);
  }

  const auto before = measure_quality(mesh), after = measure_quality(fine);
  EXPECT_EQ(fine.regions, mesh.regions);
  for (std::size_t r = 0; r < before.regions.size(); ++r)
    EXPECT_NEAR(after.regions[r].volume, before.regions[r].volume, 1e-12 * before.regions[r].volume);
  EXPECT_GT(after.min_eta, 0);

  std::set<FacetKey<Dim>> of_cells;
  std::map<FacetKey<Dim>, std::set<int>> nodes_of;
  for (const auto& cell : fine.cells)
    for (const auto& facet : outward_facets<Dim, Order>(cell))
      nodes_of[facet_key<Dim>(facet)] = std::set<int>(facet.begin(), facet.end());
  EXPECT_EQ(fine.facet_groups.size(), mesh.facet_groups.size());
  for (std::size_t g = 0; g < mesh.facet_groups.size(); ++g) {
    EXPECT_EQ(fine.facet_groups[g].name, mesh.facet_groups[g].name);
    double sum_before = 0, sum_after = 0;
    for (const auto& facet : mesh.facet_groups[g].facets) sum_before += facet_measure(mesh, facet);
    for (const auto& facet : fine.facet_groups[g].facets) {
      sum_after += facet_measure(fine, facet);
      EXPECT_EQ(nodes_of[facet_key<Dim>(facet)], std::set<int>(facet.begin(), facet.end()));
    }
    EXPECT_NEAR(sum_after, sum_before, (Order == 1 ? 1e-12 : 0.05) * sum_before);
  }
  return fine;
}

TEST(Bisection, KeepsShapeAndGroups) {
  expect_the_same_shape(section(), 300);
  expect_the_same_shape(with_mid_edge_nodes(section()), 300);
  expect_the_same_shape(test::short_artery(), 600);
  expect_the_same_shape(with_mid_edge_nodes(test::short_artery()), 1500);
  expect_the_same_shape(with_curved_edges(test::short_artery(), 1.43), 1500);
}

TEST(Bisection, MakesCellsSmallWhereWeightsAreLarge) {
  const auto mesh = test::short_artery();
  const Point place{0.3, 0, 0.2};
  const auto fine = bisect(mesh, towards(mesh, place, 4 * mesh.nodes.size()), "test");
  double near = 1e9, far = 0;
  for (const auto& cell : fine.cells) {
    std::array<Point, 4> x;
    for (int i = 0; i < 4; ++i) x[i] = fine.nodes[cell[i]];
    const double volume = simplex_volume<3>(x.data()), apart = distance(x[0], place);
    if (apart < 0.4) near = std::min(near, volume);
    if (apart > 2.5 && fine.cell_region[&cell - fine.cells.data()] == 0) far = std::max(far, volume);
  }
  EXPECT_LT(near, far / 30);
}

TEST(Bisection, HalvesNoAngleOfTriangles) {
  const auto mesh = section();
  for (const std::size_t more : {100, 1000, 5000}) {
    const auto fine = bisect(mesh, towards(mesh, {0.3, 0, 0.2}, mesh.nodes.size() + more), "test");
    EXPECT_GE(measure_quality(fine).min_angle, 0.5 * measure_quality(mesh).min_angle - 1e-9);
  }
}

TEST(Bisection, OfTetrahedraLosesQualityOnceAndNotAgain) {
  const auto mesh = test::short_artery();
  const double before = measure_quality(mesh).min_eta;
  double least = 1;
  for (const std::size_t more : {500, 5000, 20000}) {
    const auto fine = bisect(mesh, towards(mesh, {0.3, 0, 0.2}, mesh.nodes.size() + more), "test");
    least = std::min(least, measure_quality(fine).min_eta / before);
  }
  EXPECT_GT(least, 0.3);
}

TEST(Bisection, LeavesAMeshWithoutErrorAlone) {
  const auto mesh = section();
  BisectionPlan plan;
  plan.weights.assign(mesh.cells.size(), 0.0);
  plan.most_nodes = 10000;
  const auto same = bisect(mesh, plan, "test");
  EXPECT_EQ(same.nodes, mesh.nodes);
  EXPECT_EQ(same.cells, mesh.cells);
}

TEST(Bisection, RefusesAHalfThatIsInsideOut) {
  SimplexMesh<2, 2> mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, 0}, {-0.2, -0.2, 0}, {0, 0.5, 0}};
  mesh.cells = {{0, 1, 2, 3, 4, 5}};
  mesh.cell_region = {0};
  mesh.regions = {"fluid"};
  BisectionPlan plan;
  plan.weights = {1};
  plan.most_nodes = 100;
  EXPECT_THROW(bisect(mesh, plan, "folded.msh"), InputError);
}

}  // namespace
}  // namespace fsi
