// Arteries by numbers of cells: whole tubes, sectors between planes of symmetry, the meridian section.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "base/error.hpp"
#include "mesh/boundary.hpp"
#include "mesh/facets.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/point_math.hpp"
#include "mesh/quality.hpp"
#include "mesher/artery/graded_line.hpp"
#include "mesher/artery_generator.hpp"
#include "meshes.hpp"

namespace fsi {
namespace {

ArteryShape short_shape() {
  ArteryShape shape;
  shape.length = 6;
  return shape;
}

ArteryCells graded_cells() {
  ArteryCells cells;
  cells.lumen = 4;
  cells.axial = 9;
  cells.lumen_grading = 3;
  cells.axial_grading = 4;
  return cells;
}

/// Part of a circle's area that the inscribed polygon has.
double polygon(int sides) {
  return 0.5 * sides * std::sin(2 * M_PI / sides) / M_PI;
}

const double circle_areas[] = {M_PI * 1.43 * 1.43, M_PI*(1.69 * 1.69 - 1.43 * 1.43), M_PI*(1.82 * 1.82 - 1.69 * 1.69)};

TEST(GradedLine, HasOneRatioFromCellToCellAndTheAskedOneFromFirstToLast) {
  const auto ends = graded_line(18, 7, 5);
  ASSERT_EQ(ends.size(), 8u);
  EXPECT_EQ(ends.front(), 0);
  EXPECT_EQ(ends.back(), 18);
  const auto cell = [&](int i) { return ends[i + 1] - ends[i]; };
  EXPECT_NEAR(cell(0) / cell(6), 5, 1e-12);
  for (int i = 1; i < 6; ++i) EXPECT_NEAR(cell(i) / cell(i - 1), cell(i + 1) / cell(i), 1e-12);
  EXPECT_EQ(graded_line(2, 1, 7), (std::vector<double>{0, 2}));
  EXPECT_EQ(graded_line(1, 4, 1), (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
}

TEST(ArteryCellsTest, WholeTubeIsFitForUseAndFillsItsPolygons) {
  for (const int around : {8, 12, 15, 24}) {  // odd numbers spoil the chessboard of diagonals, not the mesh
    SCOPED_TRACE(around);
    auto cells = graded_cells();
    cells.around = around;
    const auto mesh = generate_artery(short_shape(), cells);
    EXPECT_NO_THROW(check_scene_mesh(mesh, test::artery_needs(), "whole"));
    const auto quality = measure_quality(mesh);
    for (int r = 0; r < 3; ++r) EXPECT_NEAR(quality.regions[r].volume, 6 * polygon(around) * circle_areas[r], 1e-11);
    EXPECT_GT(quality.min_eta, 0.05);
    EXPECT_EQ(quality.regions[1].layers, 2);
    EXPECT_EQ(quality.regions[2].layers, 2);
    EXPECT_EQ(mesh.facets("outer")->size(), 2u * around * 9);
  }
}

TEST(ArteryCellsTest, CellsAreGradedToWallAndInlet) {
  const auto mesh = generate_artery(short_shape(), graded_cells());
  std::set<double> heights, radii;
  for (const auto& x : mesh.nodes) {
    heights.insert(x[2]);
    if (x[1] == 0 && x[0] >= 0) radii.insert(x[0]);
  }
  const std::vector<double> z(heights.begin(), heights.end()), r(radii.begin(), radii.end());
  ASSERT_EQ(z.size(), 10u);
  ASSERT_EQ(r.size(), 9u);
  EXPECT_NEAR((z[9] - z[8]) / (z[1] - z[0]), 4, 1e-12);
  EXPECT_NEAR((r[1] - r[0]) / (r[4] - r[3]), 3, 1e-12);
  EXPECT_EQ(r[4], 1.43);
  EXPECT_NEAR(r[5], 1.56, 1e-14);
  EXPECT_NEAR(r[6], 1.69, 1e-14);
  EXPECT_NEAR(r[8], 1.82, 1e-14);
}

TEST(ArteryCellsTest, DiagonalsLeanBothWaysAroundTheTube) {
  const auto mesh = generate_artery(short_shape(), graded_cells());
  int left = 0, right = 0;
  for (const auto& facet : *mesh.facets("outer"))
    for (int i = 0; i < 3; ++i) {
      const Point &a = mesh.nodes[facet[i]], &b = mesh.nodes[facet[(i + 1) % 3]];
      const double around = a[0] * b[1] - a[1] * b[0], along = b[2] - a[2];
      if (std::abs(around) < 1e-9 || std::abs(along) < 1e-9) continue;
      ++(around * along > 0 ? right : left);
    }
  EXPECT_EQ(left, right);
  EXPECT_GT(left, 0);
}

/// Every facet of the boundary is in exactly one group, and groups have nothing else.
template <int Dim>
void expect_groups_complete(const SimplexMesh<Dim, 1>& mesh, const std::function<bool(const Point&)>& unnamed) {
  std::map<std::array<int, Dim>, int> named;
  for (const auto& group : mesh.facet_groups)
    for (auto facet : group.facets) {
      std::sort(facet.begin(), facet.end());
      ++named[facet];
    }
  std::size_t open = 0;
  for (const auto& [facet, cell] : boundary_facets(mesh)) {
    auto key = facet;
    std::sort(key.begin(), key.end());
    const bool all_unnamed =
        std::all_of(facet.begin(), facet.end(), [&](int node) { return unnamed(mesh.nodes[node]); });
    EXPECT_EQ(named.count(key) ? named[key] : 0, all_unnamed ? 0 : 1);
    open += all_unnamed ? 0 : 1;
  }
  EXPECT_EQ(open, named.size());
}

/// Facets of the groups have the orientation that the boundary has.
template <int Dim>
void expect_outward(const SimplexMesh<Dim, 1>& mesh) {
  std::set<std::array<int, Dim>> boundary;
  const auto rotated = [](std::array<int, Dim> facet) {
    if (Dim == 3) std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
    return facet;
  };
  for (const auto& facet : boundary_facets(mesh)) boundary.insert(rotated(facet.nodes));
  for (const auto& group : mesh.facet_groups)
    for (const auto& facet : group.facets) EXPECT_EQ(boundary.count(rotated(facet)), 1u) << group.name;
}

TEST(ArterySector, QuarterAndHalfAreFitForUseAndLieBetweenTheirPlanes) {
  for (const int degrees : {90, 180}) {
    SCOPED_TRACE(degrees);
    const auto mesh = generate_artery(short_shape(), graded_cells(), degrees);
    EXPECT_NO_THROW(check_scene_mesh(mesh, test::artery_needs(), "sector"));
    expect_groups_complete<3>(mesh, [](const Point&) { return false; });
    expect_outward<3>(mesh);
    const auto quality = measure_quality(mesh);
    for (int r = 0; r < 3; ++r)
      EXPECT_NEAR(quality.regions[r].volume, degrees / 360.0 * 6 * polygon(12) * circle_areas[r], 1e-11);

    EXPECT_EQ(mesh.facets("symmetry_x") != nullptr, degrees == 90);
    ASSERT_NE(mesh.facets("symmetry_y"), nullptr);
    if (degrees == 90) {
      for (const int node : facet_nodes(*mesh.facets("symmetry_x"))) EXPECT_EQ(mesh.nodes[node][0], 0);
    }
    for (const int node : facet_nodes(*mesh.facets("symmetry_y"))) EXPECT_EQ(mesh.nodes[node][1], 0);
    for (const auto& x : mesh.nodes) {
      EXPECT_GE(x[1], 0);
      EXPECT_GE(x[0], degrees == 90 ? 0 : -1.83);
    }
  }
}

TEST(ArterySector, OtherAnglesAreBoundedByAPlaneNormalToNoAxis) {
  for (const int degrees : {30, 45, 60, 72, 120}) {
    SCOPED_TRACE(degrees);
    auto cells = graded_cells();
    cells.around = 2 * 360 / degrees;
    const auto mesh = generate_artery(short_shape(), cells, degrees);
    EXPECT_NO_THROW(check_scene_mesh(mesh, test::artery_needs(), "sector"));
    expect_groups_complete<3>(mesh, [](const Point&) { return false; });
    expect_outward<3>(mesh);
    const auto quality = measure_quality(mesh);
    for (int r = 0; r < 3; ++r)
      EXPECT_NEAR(quality.regions[r].volume, degrees / 360.0 * 6 * polygon(cells.around) * circle_areas[r], 1e-11);
    EXPECT_EQ(mesh.facets("symmetry_x"), nullptr);
    for (const int node : facet_nodes(*mesh.facets("symmetry_y"))) EXPECT_EQ(mesh.nodes[node][1], 0);
    const double angle = degrees * std::acos(-1.0) / 180;
    for (const int node : facet_nodes(*mesh.facets("symmetry_1")))
      EXPECT_NEAR(mesh.nodes[node][0] * std::sin(angle), mesh.nodes[node][1] * std::cos(angle), 1e-15);
  }
}

TEST(ArterySector, NoTetrahedronHasAllItsNodesOnThePlanes) {
  auto cells = graded_cells();
  cells.around = 8;  // the fewest
  const auto mesh = generate_artery(short_shape(), cells, 90);
  for (const auto& cell : mesh.cells)
    EXPECT_FALSE(std::all_of(cell.begin(), cell.end(),
                             [&](int node) { return mesh.nodes[node][0] == 0 || mesh.nodes[node][1] == 0; }));
}

TEST(ArterySection, FillsTheRectanglesAndNamesTheirSides) {
  const auto mesh = generate_artery_section(short_shape(), graded_cells());
  EXPECT_EQ(mesh.regions, (std::vector<std::string>{"fluid", "media", "adventitia"}));
  EXPECT_EQ(mesh.nodes.size(), 9u * 10);
  EXPECT_EQ(mesh.cells.size(), 2u * 8 * 9);
  EXPECT_NO_THROW(check_scene_mesh(mesh, test::artery_needs(), "section"));
  std::array<double, 3> area{};
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto& [a, b, d] = mesh.cells[c];
    const Point u = mesh.nodes[b] - mesh.nodes[a], v = mesh.nodes[d] - mesh.nodes[a];
    const double twice = u[0] * v[2] - u[2] * v[0];
    EXPECT_GT(twice, 0);
    area[mesh.cell_region[c]] += 0.5 * twice;
  }
  EXPECT_NEAR(area[0], 6 * 1.43, 1e-13);
  EXPECT_NEAR(area[1], 6 * 0.26, 1e-13);
  EXPECT_NEAR(area[2], 6 * 0.13, 1e-13);
  expect_groups_complete<2>(mesh, [](const Point& x) { return x[0] == 0; });
  expect_outward<2>(mesh);

  const auto lies = [&](const char* group, const std::function<bool(const Point&)>& where) {
    for (const int node : facet_nodes(*mesh.facets(group))) EXPECT_TRUE(where(mesh.nodes[node])) << group;
  };
  lies("inlet", [](const Point& x) { return x[2] == 0 && x[0] <= 1.43; });
  lies("outlet", [](const Point& x) { return x[2] == 6 && x[0] <= 1.43; });
  lies("wall_ends", [](const Point& x) { return (x[2] == 0 || x[2] == 6) && x[0] >= 1.43; });
  lies("outer", [](const Point& x) { return std::abs(x[0] - 1.82) < 1e-14; });
}

TEST(ArterySection, DiagonalsAlternate) {
  const auto mesh = generate_artery_section(short_shape(), graded_cells());
  // Each inner node of a chessboard of diagonals has eight cells or four.
  std::vector<int> cells(mesh.nodes.size());
  for (const auto& cell : mesh.cells)
    for (const int node : cell) ++cells[node];
  for (int k = 1; k < 9; ++k)
    for (int i = 1; i < 8; ++i) EXPECT_EQ(cells[9 * k + i], (i + k) % 2 == 0 ? 8 : 4);
}

TEST(ArterySection, WithoutAdventitiaTheWallIsMediaAlone) {
  auto shape = short_shape();
  shape.adventitia = 0;
  const auto section = generate_artery_section(shape, graded_cells());
  EXPECT_EQ(section.regions, (std::vector<std::string>{"fluid", "media"}));
  EXPECT_EQ(section.nodes.size(), 7u * 10);
  EXPECT_EQ(generate_artery(shape, graded_cells(), 90).regions, (std::vector<std::string>{"fluid", "media"}));
}

void expect_refused(const std::string& message, const std::function<void(ArteryCells&)>& spoil, int degrees = 360) {
  auto cells = graded_cells();
  spoil(cells);
  try {
    generate_artery(short_shape(), cells, degrees);
    FAIL() << "accepted: " << message;
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, message.size()), message);
  }
}

TEST(ArteryCellsTest, RefusesWhatIsNoMesh) {
  const auto nothing = [](ArteryCells&) {};
  expect_refused("fsi-mesh: --lumen-cells: 0 cells will not do; give at least 1", [](auto& c) { c.lumen = 0; });
  expect_refused("fsi-mesh: --media-cells: -2 cells will not do; give at least 1", [](auto& c) { c.media = -2; });
  expect_refused("fsi-mesh: --adventitia-cells: 0 cells", [](auto& c) { c.adventitia = 0; });
  expect_refused("fsi-mesh: --around: 5 cells will not do; give at least 6", [](auto& c) { c.around = 5; });
  expect_refused("fsi-mesh: --axial-cells: 1 cells will not do; give at least 2", [](auto& c) { c.axial = 1; });
  expect_refused("fsi-mesh: --lumen-grading: a ratio of -1 will not do", [](auto& c) { c.lumen_grading = -1; });
  expect_refused("fsi-mesh: --axial-grading: a ratio of nan will not do",
                 [](auto& c) { c.axial_grading = std::numeric_limits<double>::quiet_NaN(); });
  expect_refused("fsi-mesh: --axial-cells: the cells asked for have up to 2.08e+11 nodes",
                 [](auto& c) { c.axial = std::numeric_limits<int>::max(); });
  expect_refused("fsi-mesh: --around: the cells asked for have up to 1.72e+11 nodes",
                 [](auto& c) { c.around = std::numeric_limits<int>::max(); });
  expect_refused("fsi-mesh: --axial-cells: tetrahedra of mean ratio", [](auto& c) { c.lumen_grading = 1e5; });
  // A ring of two cells in a quarter, inside one of three: its node at 45 degrees comes through the edge over it.
  const auto too_close = [](auto& c) {
    c.lumen = 2;
    c.lumen_grading = 60;
  };
  expect_refused("fsi-mesh: --lumen-grading: tetrahedra of mean ratio -", too_close, 90);
  expect_refused("fsi-mesh: --sector: 100 degrees will not do; give a whole part of the circle", nothing, 100);
  expect_refused("fsi-mesh: --sector: 0 degrees will not do", nothing, 0);
  expect_refused(
      "fsi-mesh: --around: 14 cells cannot be shared by 4 sectors of 90 degrees; give a multiple of 4",
      [](auto& c) { c.around = 14; }, 90);
}

TEST(ArterySection, RefusesFlatTriangles) {
  auto shape = short_shape();
  shape.media = 1e-9;
  EXPECT_THROW(generate_artery_section(shape, graded_cells()), InputError);
}

}  // namespace
}  // namespace fsi
