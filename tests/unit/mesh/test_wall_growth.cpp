// Walls that thicken grows: their distance from the lumen, measured by hand, in creases, over ridges and at slanted rims.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "math/pi.hpp"
#include "mesh/boundary.hpp"
#include "mesh/point_distance.hpp"
#include "mesh/surface_distance.hpp"
#include "mesh/wall_faces.hpp"
#include "mesher/wall_growth.hpp"
#include "meshes.hpp"

namespace fsi::test {

namespace {

using Facet = TetrahedralMesh::Facet;

/// Tetrahedra of a grid, six around a diagonal of each of its cubes.
/// \param place  of node (i, j, k) \param keep  whether cube (i, j, k) is there
template <class Place, class Keep>
TetrahedralMesh grid(const std::array<int, 3>& cubes, Place place, Keep keep) {
  constexpr std::array<std::array<int, 3>, 6> orders{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  const auto& [n, m, layers] = cubes;
  TetrahedralMesh mesh;
  mesh.regions = {"fluid"};
  const auto node = [nx = n + 1, ny = m + 1](int i, int j, int k) { return (k * ny + j) * nx + i; };
  for (int k = 0; k <= layers; ++k)
    for (int j = 0; j <= m; ++j)
      for (int i = 0; i <= n; ++i) mesh.nodes.push_back(place(i, j, k));
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < n; ++i)
        for (std::size_t t = 0; keep(i, j, k) && t < orders.size(); ++t) {
          std::array<int, 3> at{i, j, k};
          TetrahedralMesh::Cell cell{node(i, j, k)};
          for (int a = 0; a < 3; ++a) {
            ++at[orders[t][a]];
            cell[a + 1] = node(at[0], at[1], at[2]);
          }
          if (t >= 3) std::swap(cell[2], cell[3]);
          mesh.cells.push_back(cell);
          mesh.cell_region.push_back(0);
        }
  return mesh;
}

/// Names the facets of the boundary that lie where is_there() says.
template <class IsThere>
void name_facets(TetrahedralMesh& mesh, const std::string& name, IsThere is_there) {
  TetrahedralMesh::FacetGroup group{name, {}};
  for (const auto& facet : boundary_facets(mesh))
    if (std::all_of(facet.nodes.begin(), facet.nodes.end(), [&](int node) { return is_there(mesh.nodes[node]); }))
      group.facets.push_back(facet.nodes);
  mesh.facet_groups.push_back(group);
}

/// A block whose top is a crease (slope above 0) or a ridge along y: height slope * |x|, x from -2 to 2. The plane y = 0 is
/// `symmetry_y`.
TetrahedralMesh creased_block(double slope, int cells_along_x) {
  const int n = cells_along_x, m = 3, layers = 2;
  auto mesh = grid(
      {n, m, layers},
      [&](int i, int j, int k) {
        const double x = -2 + 4.0 * i / n, share = static_cast<double>(k) / layers;
        return Point{x, 1.0 * j / m, share * slope * std::abs(x) - (1 - share) * 5};
      },
      [](int, int, int) { return true; });
  name_facets(mesh, "left", [](const Point& x) { return x[0] < -1.999; });
  name_facets(mesh, "right", [](const Point& x) { return x[0] > 1.999; });
  name_facets(mesh, "back", [](const Point& x) { return x[1] > 0.999; });
  name_facets(mesh, "base", [](const Point& x) { return x[2] < -4.999; });
  name_facets(mesh, "symmetry_y", [](const Point& x) { return x[1] < 0.001; });
  return mesh;
}

/// A cube of 3 mm around a hollow one of 1 mm, in which the wall grows.
TetrahedralMesh block_around_a_hollow() {
  auto mesh = grid(
      {12, 12, 12},
      [](int i, int j, int k) {
        return Point{i / 3.0, j / 3.0, k / 3.0};
      },
      [](int i, int j, int k) {
        const auto within = [](int a) { return a >= 3 && a < 6; };
        return !(within(i) && within(j) && within(k));
      });
  name_facets(mesh, "outside", [](const Point& x) {
    return std::any_of(x.begin(), x.end(), [](double c) { return c < 0.01 || c > 2.99; });
  });
  return mesh;
}

double distance_to(const std::vector<Facet>& facets, const std::vector<Point>& nodes, const Point& x) {
  double least = 1e300;
  for (const auto& [a, b, c] : facets) least = std::min(least, distance_to_triangle(x, nodes[a], nodes[b], nodes[c]));
  return least;
}

std::vector<int> nodes_between(const TetrahedralMesh& mesh, const std::string& one, const std::string& other) {
  return facet_nodes(interface_facets(mesh, mesh.region_index(one), {mesh.region_index(other)}));
}

WallGrowth two_layers(int smoothing) {
  WallGrowth growth;
  growth.layers = {{"media", 0.26, 2}, {"adventitia", 0.14, 1}};
  growth.smoothing = smoothing;
  return growth;
}

struct Crease {
  const char* name;
  double degrees;  // of the slope; below 0 a ridge
  int cells, smoothing;
};

void PrintTo(const Crease& crease, std::ostream* out) {
  *out << crease.name;
}

class GrownOn : public testing::TestWithParam<Crease> {};

/// Without distances from the whole surface the wall was 57 % thick in the crease of 55 degrees and 87 % at its slanted rims,
/// and folded in steeper or finer ones.
TEST_P(GrownOn, EachLayerEndsAtItsDistance) {
  const auto& [name, degrees, cells, smoothing] = GetParam();
  const double slope = std::tan(degrees * pi / 180), asked = 0.4;
  const auto lumen = creased_block(slope, cells);
  const auto facets = facets_to_grow_on(lumen, "");
  const auto grown = grow_wall(lumen, two_layers(smoothing));
  const auto& mesh = grown.mesh;
  double lowest = 1e300;
  for (const int node : facet_nodes(*mesh.facets("outer"))) {
    EXPECT_NEAR(distance_to(facets, mesh.nodes, mesh.nodes[node]), asked, 0.01 * asked);
    lowest = std::min(lowest, mesh.nodes[node][2]);
  }
  for (const int node : nodes_between(mesh, "media", "adventitia"))
    EXPECT_NEAR(distance_to(facets, mesh.nodes, mesh.nodes[node]), 0.26, 0.01 * asked);
  if (degrees > 0) {
    // The offset's own crease, where both sides are as near: t / cos.
    const double depth = asked / std::cos(degrees * pi / 180);
    EXPECT_GT(lowest, 0.999 * depth);
    EXPECT_LT(lowest, 1.15 * depth);  // a facet may lie across
    // Seen from the lumen, away from the block's sides, which cut the wall.
    for (const int node : facet_nodes(facets))
      if (std::abs(lumen.nodes[node][0]) < 1.2) {
        EXPECT_GT(distance_to(*mesh.facets("outer"), mesh.nodes, mesh.nodes[node]), 0.99 * asked);
      }
  }
  EXPECT_EQ(grown.reached.missed, 0U);
  EXPECT_NEAR(grown.reached.least, 1, 0.01);
  EXPECT_NEAR(grown.reached.most, 1, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Blocks, GrownOn,
                         testing::Values(Crease{"crease_of_110_degrees", 35, 12, 2}, Crease{"crease_of_70", 55, 12, 2},
                                         Crease{"crease_of_70_smoothed", 55, 12, 20},
                                         Crease{"crease_of_70_fine", 55, 32, 2},
                                         Crease{"crease_of_70_fine_not_smoothed", 55, 32, 0},
                                         Crease{"crease_of_40", 70, 12, 2}, Crease{"crease_of_30", 75, 16, 2},
                                         Crease{"ridge_of_90", -45, 16, 4}),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(WallGrowth, EndsInThePlanesOfItsRims) {
  const double slope = std::tan(35 * pi / 180);
  const auto lumen = creased_block(-slope, 8);
  const auto mesh = grow_wall(lumen, two_layers(2)).mesh;
  const auto of_wall = [&](const std::string& name) {
    std::set<int> nodes;
    const auto* facets = mesh.facets(name);
    if (facets != nullptr)
      for (const auto& facet : *facets) nodes.insert(facet.begin(), facet.end());
    nodes.erase(nodes.begin(), nodes.lower_bound(static_cast<int>(lumen.nodes.size())));
    return nodes;
  };
  // Three new nodes above each of the rim's nodes.
  const auto in_symmetry = of_wall("symmetry_y"), in_ends = of_wall("wall_ends");
  EXPECT_EQ(in_symmetry.size(), 3U * 9);
  for (const int node : in_symmetry) EXPECT_NEAR(mesh.nodes[node][1], 0, 1e-12);
  EXPECT_EQ(in_ends.size(), 3U * (4 + 9 + 4 - 2));
  for (const int node : in_ends) {
    const Point& x = mesh.nodes[node];
    EXPECT_TRUE(std::abs(std::abs(x[0]) - 2) < 1e-12 || std::abs(x[1] - 1) < 1e-12);
  }
  // Over the slope's ends, which the planes x = -2 and 2 cut at an angle, the wall is t / cos high.
  double highest = -10;
  for (const int node : in_ends)
    if (std::abs(mesh.nodes[node][0]) > 1.999) highest = std::max(highest, mesh.nodes[node][2]);
  EXPECT_NEAR(highest, -2 * slope + 0.4 / std::cos(35 * pi / 180), 2e-4);
}

TEST(WallGrowth, ThicknessThatVariesIsThatOfTheNearestPoint) {
  const auto lumen = creased_block(0, 16);  // flat
  auto growth = two_layers(2);
  growth.layers = {{"media", 0.5, 1}, {"adventitia", 0.5, 1}};
  for (const auto& facet : facets_to_grow_on(lumen, ""))
    for (const int node : facet) growth.total[node] = 0.3 + 0.05 * lumen.nodes[node][0];
  const auto mesh = grow_wall(lumen, growth).mesh;
  for (const int node : facet_nodes(*mesh.facets("outer")))
    EXPECT_NEAR(mesh.nodes[node][2], 0.3 + 0.05 * mesh.nodes[node][0], 1e-4);
}

TEST(WallGrowth, SaysWhatIsMissed) {
  ReachedThickness reached;
  EXPECT_TRUE(warnings_of(reached).empty());
  reached = {0.8, 1.2, {1, 2, 3}, {4, 5, 6}, 0.4, 90, 7, 0.5, {7, 8, 9}};
  const auto warnings = warnings_of(reached);
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_NE(warnings[0].find("at 7 of 90 nodes of its outer surface: 80 % of 0.4 mm at (1, 2, 3) mm, 120 % at most"),
            std::string::npos);
  EXPECT_NE(warnings[1].find("50 % at (7, 8, 9) mm"), std::string::npos);
}

TEST(WallGrowth, TakesTheRoomThereIsAndSaysWhereThereIsNone) {
  const auto lumen = block_around_a_hollow();
  const auto facets = facets_to_grow_on(lumen, "");
  auto growth = two_layers(2);
  const auto mesh = grow_wall(lumen, growth).mesh;  // 0.4 of 0.5 mm
  for (const int node : facet_nodes(*mesh.facets("outer")))
    EXPECT_NEAR(distance_to(facets, mesh.nodes, mesh.nodes[node]), 0.4, 0.004);
  growth.layers[0].thickness = 0.5;
  std::size_t missed = 0;
  try {
    missed = grow_wall(lumen, growth).reached.missed;
  } catch (const InputError&) {
    missed = 1;
  }
  EXPECT_GT(missed, 0U);
}

TEST(SurfaceDistance, IsThatToTheNearestFacet) {
  std::mt19937 numbers(7);
  std::uniform_real_distribution<double> within(-1, 1);
  const auto any = [&] { return Point{within(numbers), within(numbers), within(numbers)}; };
  std::vector<Point> nodes;
  for (int i = 0; i < 150; ++i) nodes.push_back(any());
  std::vector<SurfaceDistance::Facet> triangles, edges;
  for (int i = 0; i + 2 < 150; i += 3) {
    triangles.push_back({i, i + 1, i + 2});
    edges.push_back({i, i + 1, i + 1});
  }
  const SurfaceDistance surface(nodes, triangles), line(nodes, edges);
  for (int i = 0; i < 200; ++i) {
    const Point x = 2 * any();
    double expected = 1e300, expected_of_edges = 1e300;
    for (const auto& [a, b, c] : triangles) {
      expected = std::min(expected, distance_to_triangle(x, nodes[a], nodes[b], nodes[c]));
      expected_of_edges = std::min(expected_of_edges, distance_to_segment(x, nodes[a], nodes[b]));
    }
    const auto found = surface.nearest(x, i % 50);
    EXPECT_NEAR(found.distance, expected, 1e-12);
    EXPECT_NEAR(distance(x, found.at), expected, 1e-12);
    EXPECT_NEAR(line.nearest(x).distance, expected_of_edges, 1e-12);
  }
}

TEST(WallFaces, ThicknessOfAnArteryAndItsLayers) {
  const auto mesh = coarse_artery();
  const auto ranges = thickness_ranges(mesh);
  ASSERT_EQ(ranges.size(), 3U);
  const std::vector<std::pair<std::string, double>> expected{{"media", 0.26}, {"adventitia", 0.13}, {"wall", 0.39}};
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    EXPECT_EQ(ranges[i].name, expected[i].first);
    EXPECT_NEAR(ranges[i].least.distance, expected[i].second, 1e-12);  // from vertex to vertex
    EXPECT_NEAR(ranges[i].most.distance, expected[i].second, 1e-12);
    // From a vertex to the chord of twelve.
    EXPECT_NEAR(ranges[i].least_seen_from_inside.distance, expected[i].second * std::cos(pi / 12), 1e-3);
  }
  const auto thickness = nodal_thickness(mesh);
  ASSERT_EQ(thickness.size(), mesh.nodes.size());
  for (const int node : facet_nodes(*mesh.facets("outer"))) EXPECT_NEAR(thickness[node], 0.39, 1e-12);
  for (std::size_t i = 0; i < thickness.size(); ++i) {
    const bool in_fluid = std::hypot(mesh.nodes[i][0], mesh.nodes[i][1]) < 1.4;
    EXPECT_EQ(thickness[i] == 0, in_fluid);
  }
}

// A part of a layer has faces that are none of the layer's: those around it, and those that it takes from the layer's own.
TEST(WallFaces, APartCutOutOfALayerBelongsToItsThickness) {
  auto mesh = coarse_artery();
  const auto whole = thickness_ranges(mesh);
  const int media = mesh.region_index("media"), part = static_cast<int>(mesh.regions.size());
  mesh.regions.push_back("media/plaque");
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (mesh.cell_region[c] == media && mesh.nodes[mesh.cells[c][0]][0] > 0.5) mesh.cell_region[c] = part;
  const auto ranges = thickness_ranges(mesh);
  ASSERT_EQ(ranges.size(), whole.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    EXPECT_EQ(ranges[i].name, whole[i].name);
    EXPECT_EQ(ranges[i].least.distance, whole[i].least.distance);
    EXPECT_EQ(ranges[i].most.distance, whole[i].most.distance);
    EXPECT_EQ(ranges[i].least_seen_from_inside.distance, whole[i].least_seen_from_inside.distance);
  }
}

TEST(WallFaces, AreNoneWithoutAWall) {
  auto mesh = creased_block(0, 4);
  EXPECT_TRUE(thickness_ranges(mesh).empty());
  EXPECT_TRUE(nodal_thickness(mesh).empty());
  mesh.regions = {"block"};  // a wall that surrounds nothing
  EXPECT_FALSE(faces_of_wall(mesh).has_value());
}

}  // namespace

}  // namespace fsi::test
