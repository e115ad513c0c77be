#include <gtest/gtest.h>

#include "fem/elements.hpp"
#include "partitioned/interface/wetted_sides.hpp"
#include "support/scenes.hpp"

namespace fsi::test {

namespace {

/// Unit quadrilaterals cut into triangles, `wall(i, j)` those of the wall; inlet left, outlet right, held below.
template <class Place, class Wall>
TriangleMesh channel_with(std::array<int, 2> n, Place place, Wall wall) {
  auto mesh = triangle_grid(n, {"fluid", "media"}, place, [&](int i, int j) { return wall(i, j) ? 1 : 0; });
  std::map<std::string, std::vector<TriangleMesh::Facet>> groups;
  for (const auto& side : boundary_sides(mesh)) {
    const int columns = n[0] + 1, a = side[0], b = side[1];
    const bool of_wall = wall(std::min(a, b) % columns, std::min(std::min(a, b) / columns, n[1] - 1));
    const bool below = a / columns == 0 && b / columns == 0;
    if (below) groups[of_wall ? "wall_ends" : "floor"].push_back(side);
    if (a % columns == 0 && b % columns == 0) groups["inlet"].push_back(side);
    if (a % columns == n[0] && b % columns == n[0]) groups["outlet"].push_back(side);
  }
  for (const auto& [name, sides] : groups) mesh.facet_groups.push_back({name, sides});
  return mesh;
}

Case one_layer() {
  Case setup = coupled_case("neo-hookean");
  setup.structure->layers.erase("adventitia");
  return setup;
}

TEST(WettedSides, APillarInAChannelStandsInTheFluid) {
  Case setup = one_layer();
  setup.geometry = Geometry::plane;
  const auto mesh = channel_with(
      {6, 5},
      [](int i, int j) {
        return Point{1.0 * i, 1.0 * j, 0.0};
      },
      [](int i, int j) { return i >= 2 && i < 4 && j < 3; });
  const WettedSides sides = wetted_sides_of(*build_scene<P1PlaneTriangle>(setup, mesh));
  EXPECT_DOUBLE_EQ(sides.wet, 3 + 2 + 3);
  EXPECT_DOUBLE_EQ(sides.dry, 2);
  EXPECT_TRUE(sides.stands_in_the_fluid());
}

TEST(WettedSides, AWallBesideTheFluidDoesNot) {
  const auto scene = build_scene<P1Tetrahedron>(coupled_case("neo-hookean"), fluid_and_wall_box(2));
  const WettedSides sides = wetted_sides_of(*scene);
  EXPECT_NEAR(sides.wet, 1, 1e-12);
  EXPECT_NEAR(sides.dry, 1 + 4 * 0.39, 1e-12);
  EXPECT_FALSE(sides.stands_in_the_fluid());
}

// Faces count with their circumference: a tube's outer face is larger than its inner one, also where its ends, on planes
// of symmetry, do not count, and where it is held along the axis.
TEST(WettedSides, ATubeDoesNot) {
  Case setup = one_layer();
  setup.geometry = Geometry::axisymmetric;
  auto mesh = triangle_grid(
      {3, 4}, {"fluid", "media"},
      [](int i, int j) {
        return Point{1.0 * i, 0.0, 1.0 * j};
      },
      [](int i, int) { return i < 2 ? 0 : 1; });
  std::map<std::string, std::vector<TriangleMesh::Facet>> groups;
  for (const auto& side : boundary_sides(mesh)) {
    const Point &a = mesh.nodes[side[0]], &b = mesh.nodes[side[1]];
    const bool wall = a[0] + b[0] > 4;
    if (a[2] == b[2])
      groups[wall ? "symmetry_z" : (a[2] == 0 ? "inlet" : "outlet")].push_back(side);
    else if (wall)
      groups["outer"].push_back(side);
  }
  for (const auto& [name, sides] : groups) mesh.facet_groups.push_back({name, sides});
  for (const bool held : {false, true}) {
    if (held) setup.supports["outer"].fixed = {"z"};
    const WettedSides sides = wetted_sides_of(*build_scene<P1AxisymmetricTriangle>(setup, mesh));
    EXPECT_DOUBLE_EQ(sides.wet, 2 * 4);
    EXPECT_DOUBLE_EQ(sides.dry, 3 * 4);
    EXPECT_FALSE(sides.stands_in_the_fluid());
  }
}

}  // namespace

}  // namespace fsi::test
