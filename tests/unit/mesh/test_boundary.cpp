#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "mesh/boundary.hpp"
#include "mesh/facets.hpp"
#include "mesh/point_math.hpp"
#include "meshes.hpp"

namespace fsi {
namespace {

Point area(const TetrahedralMesh& mesh, const TetrahedralMesh::Facet& f) {
  return triangle_area_vector(mesh.nodes[f[0]], mesh.nodes[f[1]], mesh.nodes[f[2]]);
}

Point centre(const TetrahedralMesh& mesh, const TetrahedralMesh::Facet& f) {
  return (1.0 / 3) * (mesh.nodes[f[0]] + mesh.nodes[f[1]] + mesh.nodes[f[2]]);
}

TEST(Boundary, OutwardFacetsOfATetrahedronLookAway) {
  const std::vector<Point> x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto facets = outward_facets({0, 1, 2, 3});
  for (int i = 0; i < 4; ++i) {
    const auto& f = facets[i];
    EXPECT_LT(dot(triangle_area_vector(x[f[0]], x[f[1]], x[f[2]]), x[i] - x[f[0]]), 0);
    EXPECT_EQ(std::count(f.begin(), f.end(), i), 0);
  }
}

TEST(Boundary, IsClosedAndEnclosesTheVolume) {
  const auto mesh = test::coarse_artery();
  Point sum{0, 0, 0};
  double enclosed = 0, volume = 0;
  for (const auto& facet : boundary_facets(mesh, {1, 2})) {
    sum = sum + area(mesh, facet.nodes);
    enclosed += dot(area(mesh, facet.nodes), centre(mesh, facet.nodes)) / 3;  // divergence theorem for x/3
  }
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (mesh.cell_region[c] != 0) {
      const auto& t = mesh.cells[c];
      volume += tetrahedron_volume(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]], mesh.nodes[t[3]]);
    }
  EXPECT_NEAR(norm(sum), 0, 1e-12);
  EXPECT_NEAR(enclosed, volume, 1e-10);
}

TEST(Boundary, InterfaceIsTheFacetedCylinderSeenFromTheFluid) {
  const auto mesh = test::coarse_artery();
  const auto interface = interface_facets(mesh, 0, {1, 2});
  double total = 0;
  for (const auto& facet : interface) {
    const Point x = centre(mesh, facet);
    EXPECT_GT(dot(area(mesh, facet), {x[0], x[1], 0}), 0);
    total += norm(area(mesh, facet));
  }
  // 23 slabs of 24 triangles: base between two of twelve nodes around, tip at the angle half way between them.
  const double base = 2 * 1.43 * std::sin(M_PI / 12), height = std::hypot(18.0 / 23, 1.43 * (1 - std::cos(M_PI / 12)));
  EXPECT_NEAR(total, 23 * 24 * 0.5 * base * height, 1e-10);
  EXPECT_NEAR(total, 2 * M_PI * 1.43 * 18, 0.012 * total);  // faceting error, at most (pi/n)^2/6
}

TEST(Boundary, InterfaceDoesNotDependOnWhichLayersAreListed) {
  const auto mesh = test::coarse_artery();
  EXPECT_EQ(interface_facets(mesh, 0, {1}), interface_facets(mesh, 0, {2, 1}));
  EXPECT_TRUE(interface_facets(mesh, 0, {2}).empty());
  EXPECT_TRUE(interface_facets(mesh, 0, {}).empty());
}

TEST(Boundary, RimOfTheInterfaceIsItsTwoCircles) {
  const auto mesh = test::coarse_artery();
  const auto rim = rim_nodes(interface_facets(mesh, 0, {1, 2}));
  EXPECT_EQ(rim.size(), 24u);
  for (const int node : rim) EXPECT_TRUE(mesh.nodes[node][2] == 0 || mesh.nodes[node][2] == 18);
}

}  // namespace
}  // namespace fsi
