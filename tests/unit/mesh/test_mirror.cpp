#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "mesh/curved_cells.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/mirror.hpp"
#include "mesh/quality.hpp"
#include "mesher/artery/curved_edges.hpp"
#include "mesher/artery/sector_images.hpp"
#include "mesher/artery_generator.hpp"
#include "meshes.hpp"

namespace fsi {
namespace {

TetrahedralMesh quarter() {
  ArteryShape shape;
  shape.length = 2;
  ArteryCells cells;
  cells.axial = 3;
  cells.lumen_grading = cells.axial_grading = 2;
  return generate_artery(shape, cells, 90);
}

/// The mesh's image in a plane has the same nodes and cells.
template <int Order>
void expect_symmetric(const SimplexMesh<3, Order>& mesh, int axis) {
  std::map<Point, int> at;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) at[mesh.nodes[i]] = static_cast<int>(i);
  ASSERT_EQ(at.size(), mesh.nodes.size());
  const auto sorted = [](auto cell) {
    std::sort(cell.begin(), cell.end());
    return cell;
  };
  std::set<typename SimplexMesh<3, Order>::Cell> cells;
  for (const auto& cell : mesh.cells) cells.insert(sorted(cell));
  for (auto cell : mesh.cells) {
    for (int& node : cell) {
      Point x = mesh.nodes[node];
      x[axis] = x[axis] == 0 ? 0 : -x[axis];
      ASSERT_EQ(at.count(x), 1u);
      node = at[x];
    }
    EXPECT_EQ(cells.count(sorted(cell)), 1u);
  }
}

TEST(Mirror, FourQuartersAreTheWholeTube) {
  const auto part = quarter();
  const auto half = joined_with_mirror_image(part, 1);
  EXPECT_EQ(half.facets("symmetry_y"), nullptr);
  EXPECT_EQ(half.facets("symmetry_x")->size(), 2 * part.facets("symmetry_x")->size());
  EXPECT_NO_THROW(check_scene_mesh(half, test::artery_needs(), "half"));
  const auto whole = joined_with_mirror_image(half, 0);
  EXPECT_EQ(whole.facets("symmetry_x"), nullptr);
  EXPECT_NO_THROW(check_scene_mesh(whole, test::artery_needs(), "whole"));
  EXPECT_EQ(whole.cells.size(), 4 * part.cells.size());
  for (const char* group : {"inlet", "outlet", "wall_ends", "outer"})
    EXPECT_EQ(whole.facets(group)->size(), 4 * part.facets(group)->size()) << group;
  const auto of_part = measure_quality(part), of_whole = measure_quality(whole);
  EXPECT_NEAR(of_whole.min_eta, of_part.min_eta, 1e-12);  // positive: no cell is inside out
  for (int r = 0; r < 3; ++r) EXPECT_NEAR(of_whole.regions[r].volume, 4 * of_part.regions[r].volume, 1e-12);
  expect_symmetric(whole, 0);
  expect_symmetric(whole, 1);
  // The quarter's own cells and nodes come first.
  EXPECT_TRUE(std::equal(part.nodes.begin(), part.nodes.end(), whole.nodes.begin()));
  EXPECT_TRUE(std::equal(part.cells.begin(), part.cells.end(), whole.cells.begin()));
}

TEST(Mirror, QuadraticCellsKeepTheirEdges) {
  const auto part = with_curved_edges(quarter(), 1.43);
  const auto whole = joined_with_mirror_image(joined_with_mirror_image(part, 1), 0);
  expect_symmetric(whole, 0);
  expect_symmetric(whole, 1);
  for (const auto& cell : whole.cells) {
    std::array<Point, 10> x;
    for (int a = 0; a < 10; ++a) x[a] = whole.nodes[cell[a]];
    const auto j = cell_jacobian<3>(x);  // a middle at another edge would fold the cell
    ASSERT_TRUE(j.positive);
    ASSERT_GT(j.ratio(), 0.7);
  }
  // Curved first or mirrored first, it is one mesh but for the numbers of its nodes.
  const auto other = with_curved_edges(joined_with_mirror_image(joined_with_mirror_image(quarter(), 1), 0), 1.43);
  const auto sorted = [](std::vector<Point> nodes) {
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  };
  EXPECT_EQ(sorted(whole.nodes), sorted(other.nodes));
}

TEST(SectorImages, AreTheWholeTube) {
  ArteryShape shape;
  shape.length = 2;
  ArteryCells cells;
  cells.around = 24;
  cells.axial = 3;
  for (const int degrees : {30, 45, 60, 90}) {
    SCOPED_TRACE(degrees);
    const auto part = generate_artery(shape, cells, degrees);
    const int images = 360 / degrees;
    const char* last = degrees == 90 ? "symmetry_x" : "symmetry_1";
    const auto whole = joined_with_sector_images(part, degrees, "symmetry_y", last);
    EXPECT_NO_THROW(check_scene_mesh(whole, test::artery_needs(), "whole"));
    EXPECT_EQ(whole.facets("symmetry_y"), nullptr);
    EXPECT_EQ(whole.facets(last), nullptr);
    EXPECT_EQ(whole.cells.size(), images * part.cells.size());
    // Nodes inside a sector count once for each, those on a plane once for two, those on the axis once.
    std::set<int> first, second;
    for (const auto& facet : *part.facets("symmetry_y")) first.insert(facet.begin(), facet.end());
    for (const auto& facet : *part.facets(last)) second.insert(facet.begin(), facet.end());
    std::size_t axis = 0;
    for (const int node : first) axis += second.count(node);
    const std::size_t on_planes = first.size() + second.size() - 2 * axis;
    EXPECT_EQ(axis, 4u);
    EXPECT_EQ(whole.nodes.size(), images * (part.nodes.size() - on_planes - axis) + images / 2 * on_planes + axis);
    for (const char* group : {"inlet", "outlet", "wall_ends", "outer"})
      EXPECT_EQ(whole.facets(group)->size(), images * part.facets(group)->size()) << group;
    const auto of_part = measure_quality(part), of_whole = measure_quality(whole);
    EXPECT_NEAR(of_whole.min_eta, of_part.min_eta, 1e-12);
    for (int r = 0; r < 3; ++r) EXPECT_NEAR(of_whole.regions[r].volume, images * of_part.regions[r].volume, 1e-11);
    EXPECT_TRUE(std::equal(part.nodes.begin(), part.nodes.end(), whole.nodes.begin()));
    EXPECT_TRUE(std::equal(part.cells.begin(), part.cells.end(), whole.cells.begin()));
  }
}

TEST(Mirror, ReversedSimplexKeepsEachEdgesMiddle) {
  // Middles are named by the sum of 10 to the power of their ends.
  const std::array<int, 10> tetrahedron{0, 1, 2, 3, 11, 110, 101, 1001, 1010, 1100};
  EXPECT_EQ(reversed<3>(tetrahedron), (std::array<int, 10>{1, 0, 2, 3, 11, 101, 110, 1010, 1001, 1100}));
  EXPECT_EQ(reversed<2>(std::array<int, 6>{0, 1, 2, 11, 110, 101}), (std::array<int, 6>{1, 0, 2, 11, 101, 110}));
  EXPECT_EQ(reversed<1>(std::array<int, 3>{0, 1, 11}), (std::array<int, 3>{1, 0, 11}));
  EXPECT_EQ(reversed<2>(std::array<int, 3>{0, 1, 2}), (std::array<int, 3>{1, 0, 2}));
}

}  // namespace
}  // namespace fsi
