// Parts whose regions have vertices of their own where they meet.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "mesh/mid_edge_nodes.hpp"
#include "mesh/submesh.hpp"
#include "support/meshes.hpp"

namespace fsi::test {

namespace {

/// Copies of each mesh node.
template <class Part>
std::map<int, std::vector<int>> copies_of(const Part& part) {
  std::map<int, std::vector<int>> copies;
  for (int a = 0; a < part.node_count(); ++a) copies[part.mesh_node[a]].push_back(a);
  return copies;
}

/// What holds for every part that was split, against the part it was made of. \param vertices  of a cell
template <class Part>
void expect_split(const Part& split, const Part& part, std::size_t vertices) {
  ASSERT_EQ(split.cells.size(), part.cells.size());
  EXPECT_EQ(split.cell_region, part.cell_region);
  std::map<int, std::set<int>> regions, wanted;  // of nodes of the split part; of nodes of the mesh
  for (std::size_t c = 0; c < part.cells.size(); ++c)
    for (std::size_t a = 0; a < part.cells[c].size(); ++a) {
      const int node = split.cells[c][a], mesh_node = part.mesh_node[part.cells[c][a]];
      EXPECT_EQ(split.mesh_node[node], mesh_node) << "the cell stays where it is";
      EXPECT_EQ(split.nodes[node], part.nodes[part.cells[c][a]]);
      if (a >= vertices) {
        EXPECT_EQ(split.original_of(node), node) << "no copies in the middle of edges";
        continue;
      }
      regions[node].insert(split.cell_region[c]);
      wanted[mesh_node].insert(part.cell_region[c]);
    }
  for (const auto& [node, its] : regions) EXPECT_EQ(its.size(), 1u) << "no vertex belongs to two regions";
  for (const auto& [mesh_node, copies] : copies_of(split)) {
    if (wanted.count(mesh_node) > 0) {
      EXPECT_EQ(copies.size(), wanted[mesh_node].size());
    }
    EXPECT_EQ(split.local_node[mesh_node], copies[0]);
    for (std::size_t i = 0; i < copies.size(); ++i) {
      EXPECT_EQ(copies[i], copies[0] + static_cast<int>(i)) << "side by side";
      EXPECT_EQ(split.original_of(copies[i]), copies[0]);
    }
  }
}

TEST(SplitBetweenRegions, GivesEachLayerOfTheWallItsVertices) {
  const auto mesh = fluid_and_wall_box(2);
  const auto wall = submesh(mesh, {1, 2});
  const auto split = split_between_regions(wall);
  expect_split(split, wall, 4);
  EXPECT_TRUE(split.has_copies());
  EXPECT_FALSE(wall.has_copies());
  EXPECT_EQ(split.node_count(), wall.node_count() + 9) << "the plane between the layers";
}

TEST(SplitBetweenRegions, CopiesNoNodesInTheMiddleOfEdges) {
  const auto mesh = with_mid_edge_nodes(fluid_and_wall_box(2));
  const auto wall = submesh(mesh, {1, 2});
  const auto split = split_between_regions(wall);
  expect_split(split, wall, 4);
  EXPECT_EQ(split.node_count(), wall.node_count() + 9);
}

TEST(SplitBetweenRegions, AsManyCopiesAsRegionsMeet) {
  const auto mesh = triangle_grid(
      {2, 2}, {"a", "b", "c", "d"},
      [](int i, int j) {
        return Point{1.0 + i, 0, 1.0 * j};
      },
      [](int i, int j) { return i + 2 * j; });
  const auto part = whole(mesh);
  const auto split = split_between_regions(part);
  expect_split(split, part, 3);
  EXPECT_EQ(split.node_count(), 9 + 3 + 4) << "four regions meet in the centre, two in the middle of each side";
}

TEST(SplitBetweenRegions, LeavesAPartAloneWhoseRegionsDoNotMeet) {
  const auto mesh = fluid_and_wall_box(2);
  const auto media = submesh(mesh, {1});
  const auto split = split_between_regions(media);
  EXPECT_FALSE(split.has_copies());
  EXPECT_EQ(split.cells, media.cells);
  EXPECT_EQ(split.local_node, media.local_node);
  EXPECT_EQ(split.original_of(3), 3);
}

TEST(SplitBetweenRegions, ValuesSpreadToTheCopies) {
  const auto split = split_between_regions(submesh(fluid_and_wall_box(2), {1, 2}));
  std::vector<int> numbers(split.nodes.size());
  for (int a = 0; a < split.node_count(); ++a) numbers[a] = a;
  split.spread_to_copies(numbers);
  for (int a = 0; a < split.node_count(); ++a) EXPECT_EQ(numbers[a], split.original_of(a));
}

// The inner face of two layers side by side: where they meet, each facet has the vertex of its own layer.
template <int Order>
void expect_facets_of_their_cells(const SimplexMesh<2, Order>& mesh) {
  const auto split = split_between_regions(whole(mesh));
  std::vector<typename SimplexMesh<2, Order>::Facet> facets;
  for (const auto& facet : boundary_facets(mesh)) facets.push_back(split.local(facet.nodes));
  const auto named_by_originals = facets;
  name_copies_of_cells(split, facets);
  int renamed = 0;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    int behind = 0;
    for (const auto& cell : split.cells)
      behind += std::all_of(facets[f].begin(), facets[f].end(),
                            [&](int node) { return std::find(cell.begin(), cell.end(), node) != cell.end(); });
    EXPECT_EQ(behind, 1);
    for (std::size_t a = 0; a < facets[f].size(); ++a) {
      EXPECT_EQ(split.original_of(facets[f][a]), named_by_originals[f][a]) << "the same place and order";
      renamed += facets[f][a] != named_by_originals[f][a];
    }
  }
  EXPECT_EQ(renamed, 2) << "below and above, the facet of the layer that does not own the original";
}

TEST(SplitBetweenRegions, FacetsNameTheVerticesOfTheCellBehindThem) {
  const auto mesh = triangle_grid(
      {2, 1}, {"left", "right"},
      [](int i, int j) {
        return Point{1.0 + i, 0, 1.0 * j};
      },
      [](int i, int) { return i; });
  expect_facets_of_their_cells(mesh);
  expect_facets_of_their_cells(with_mid_edge_nodes(mesh));
}

}  // namespace

}  // namespace fsi::test
