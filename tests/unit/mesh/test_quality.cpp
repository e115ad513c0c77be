#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <utility>

#include "mesh/boundary.hpp"
#include "mesh/cells_across.hpp"
#include "mesh/point_math.hpp"
#include "mesh/quality.hpp"
#include "meshes.hpp"
#include "support/meshes.hpp"

namespace fsi {
namespace {

const std::array<Point, 4> regular{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};
const std::array<Point, 4> corner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

std::array<Point, 4> swapped(std::array<Point, 4> x) {
  std::swap(x[2], x[3]);
  return x;
}

TEST(Quality, RegularTetrahedron) {
  EXPECT_NEAR(std::abs(mean_ratio(regular)), 1, 1e-14);
  EXPECT_NEAR(smallest_dihedral(regular), std::acos(1.0 / 3) * 180 / M_PI, 1e-12);
}

TEST(Quality, CornerTetrahedron) {
  // V = 1/6, edges 3 x 1 and 3 x sqrt(2): eta = 12 (1/2)^(2/3) / 9; between a leg face and the slanted one
  // acos(1/sqrt 3)
  EXPECT_NEAR(mean_ratio(corner), 12 * std::pow(0.5, 2.0 / 3) / 9, 1e-14);
  EXPECT_NEAR(smallest_dihedral(corner), std::acos(1 / std::sqrt(3.0)) * 180 / M_PI, 1e-12);
}

TEST(Quality, InvertedIsNegativeAndFlatIsZero) {
  EXPECT_DOUBLE_EQ(mean_ratio(swapped(corner)), -mean_ratio(corner));
  EXPECT_EQ(mean_ratio({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}}), 0);
}

TEST(Quality, CountsLayersAcrossTheWall) {
  ArteryOptions options;
  options.media = 1.0;
  options.adventitia = 0.5;
  options.length = 4;
  const auto mesh = generate_artery(options);  // rings of 0.35 * 0.75 mm: 4 and 2
  EXPECT_EQ(element_layers(mesh, 0), 0);
  EXPECT_EQ(element_layers(mesh, 1), 4);
  EXPECT_EQ(element_layers(mesh, 2), 2);
}

TEST(CellsAcross, AreTheDiameterOverTheMeanEdge) {
  const auto mesh = test::short_artery();
  const auto across = cells_across(mesh);
  ASSERT_TRUE(across);
  // 4 V / A = 4 (pi R^2 L) / (2 pi R L) = 2 R, but for what straight facets cut off; its interface has no name, its ends have.
  EXPECT_NEAR(across->width, 2 * 1.43, 0.05 * 1.43);
  double length = 0, count = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (mesh.regions[mesh.cell_region[c]] == "fluid")
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b < a; ++b, ++count)
          length += distance(mesh.nodes[mesh.cells[c][a]], mesh.nodes[mesh.cells[c][b]]);
  EXPECT_NEAR(across->cells(), across->width * count / length, 1e-12 * across->cells());
}

TEST(CellsAcross, CountTheWallsOfTheLumenWhateverTheirNames) {
  const auto mesh = test::short_artery();
  const auto expected = cells_across(mesh);
  const auto interface = interface_facets(mesh, 0, {1, 2});
  ASSERT_TRUE(expected);
  auto alone = mesh;
  for (std::size_t c = alone.cells.size(); c-- > 0;)
    if (alone.cell_region[c] != 0) {
      alone.cells.erase(alone.cells.begin() + static_cast<std::ptrdiff_t>(c));
      alone.cell_region.erase(alone.cell_region.begin() + static_cast<std::ptrdiff_t>(c));
    }
  for (auto [changed, name] : {std::pair(mesh, "lumen"), std::pair(mesh, "inner"), std::pair(alone, "wall")}) {
    changed.facet_groups.push_back({name, interface});
    const auto across = cells_across(changed);
    ASSERT_TRUE(across) << name;
    EXPECT_DOUBLE_EQ(across->width, expected->width) << name;
  }
  alone.facet_groups.push_back({"lumen", interface});
  EXPECT_FALSE(cells_across(alone)) << "all of it may be openings";
}

TEST(CellsAcross, NeedAFluid) {
  EXPECT_FALSE(cells_across(test::irregular_cube(2, 0.1, "media")));
}

TEST(Quality, WarnsOfBadElementsAndSaysWhereTheWorstIs) {
  EXPECT_TRUE(warnings_of(measure_quality(test::short_artery())).empty());
  ArteryOptions thin;
  thin.adventitia = 0.01;
  thin.length = 4;
  const auto mesh = generate_artery(thin);
  const auto quality = measure_quality(mesh);
  EXPECT_EQ(quality.regions[0].poor, 0u);
  const auto& sleeve = quality.regions[2];
  EXPECT_EQ(sleeve.poor, sleeve.cells);  // 0.01 mm across, forty times as much around
  ASSERT_GE(sleeve.worst, 0);
  EXPECT_EQ(mesh.cell_region[sleeve.worst], 2);
  EXPECT_NEAR(std::hypot(sleeve.worst_at[0], sleeve.worst_at[1]), 1.43 + 0.26, 0.1);
  const auto warnings = warnings_of(quality);
  ASSERT_FALSE(warnings.empty());
  EXPECT_EQ(warnings.back().rfind("adventitia: ", 0), 0u) << warnings.back();
  EXPECT_NE(warnings.back().find("tetrahedron " + std::to_string(sleeve.worst + 1) + " near"), std::string::npos);
}

TEST(Quality, ReportAddsUp) {
  const auto mesh = test::short_artery();
  const auto quality = measure_quality(mesh);
  std::size_t tetrahedra = 0;
  for (const auto& region : quality.regions) tetrahedra += region.cells;
  EXPECT_EQ(tetrahedra, mesh.cells.size());
  EXPECT_EQ(quality.nodes, mesh.nodes.size());
  EXPECT_LE(quality.min_eta, quality.mean_eta);
  const auto text = to_text(quality);
  EXPECT_NE(text.find("adventitia"), std::string::npos);
  EXPECT_NE(text.find("smallest dihedral"), std::string::npos);
}

}  // namespace
}  // namespace fsi
