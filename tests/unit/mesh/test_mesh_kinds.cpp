// Facets, orders, quality and checks of triangle meshes and quadratic meshes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "mesh/boundary.hpp"
#include "mesh/facets.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesh/point_math.hpp"
#include "mesh/quality.hpp"
#include "mesh/renumber.hpp"
#include "mesh/symmetry_planes.hpp"
#include "mesher/artery_generator.hpp"
#include "meshes.hpp"
#include "support/meshes.hpp"

namespace fsi {
namespace {

/// A tube in the (r, z) plane: fluid r < 1, wall to 1.5, 0 < z < 3, with its groups.
TriangleMesh meridian_tube() {
  auto mesh = test::triangle_grid(
      {6, 6}, {"fluid", "media"},
      [](int i, int j) {
        return Point{0.25 * i, 0, 0.5 * j};
      },
      [](int i, int) { return i < 4 ? 0 : 1; });
  const auto group = [&](const char* name, int region, auto holds) {
    mesh.facet_groups.push_back({name, {}});
    for (const auto& facet : boundary_facets(mesh, {region}))
      if (std::all_of(facet.nodes.begin(), facet.nodes.end(), [&](int n) { return holds(mesh.nodes[n]); }))
        mesh.facet_groups.back().facets.push_back(facet.nodes);
  };
  group("inlet", 0, [](const Point& x) { return x[2] == 0; });
  group("outlet", 0, [](const Point& x) { return x[2] == 3; });
  group("wall_ends", 1, [](const Point& x) { return x[2] == 0; });
  group("symmetry_z", 1, [](const Point& x) { return x[2] == 3; });
  group("outer", 1, [](const Point& x) { return x[0] == 1.5; });
  return mesh;
}

SceneMeshNeeds tube_needs() {
  SceneMeshNeeds needs;
  needs.fluid = needs.inlet = needs.outlet = true;
  needs.layers = {"media"};
  return needs;
}

template <int Dim, int Order>
std::string verdict(const SimplexMesh<Dim, Order>& mesh, const SceneMeshNeeds& needs) {
  try {
    check_scene_mesh(mesh, needs, "mesh");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::vector<TriangleMesh::Facet>& group_of(TriangleMesh& mesh, const std::string& name) {
  return std::find_if(mesh.facet_groups.begin(), mesh.facet_groups.end(), [&](auto& g) { return g.name == name; })
      ->facets;
}

TEST(MeshKinds, QuadraticFacetsAreThoseOfTheirCells) {
  const auto linear = test::short_artery();
  const auto mesh = with_mid_edge_nodes(linear);
  const auto faces = boundary_facets(mesh, {0});
  const auto straight = boundary_facets(linear, {0});
  ASSERT_EQ(faces.size(), straight.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto& nodes = faces[f].nodes;
    EXPECT_TRUE(std::equal(straight[f].nodes.begin(), straight[f].nodes.end(), nodes.begin()));
    for (int e = 0; e < 3; ++e)
      EXPECT_NEAR(distance(mesh.nodes[nodes[3 + e]], 0.5 * (mesh.nodes[nodes[e]] + mesh.nodes[nodes[(e + 1) % 3]])), 0,
                  1e-14);
  }
  EXPECT_EQ(rim_nodes(interface_facets(mesh, 0, {1, 2})).size(),
            2 * rim_nodes(interface_facets(linear, 0, {1, 2})).size());
}

TEST(MeshKinds, TriangleSidesLookOutwards) {
  const auto mesh = with_mid_edge_nodes(meridian_tube());
  Point sum{0, 0, 0};
  double enclosed = 0;
  for (const auto& side : boundary_facets(mesh, {0})) {
    const Point &a = mesh.nodes[side.nodes[0]], &b = mesh.nodes[side.nodes[1]];
    const Point normal{b[2] - a[2], 0, a[0] - b[0]};
    sum = sum + normal;
    enclosed += 0.5 * dot(normal, mesh.nodes[side.nodes[2]]);  // divergence theorem for x/2
  }
  EXPECT_NEAR(norm(sum), 0, 1e-14);
  EXPECT_NEAR(enclosed, 3, 1e-14);
  const auto interface = interface_facets(mesh, 0, {1});
  EXPECT_EQ(interface.size(), 6u);
  for (const auto& side : interface) EXPECT_GT(mesh.nodes[side[1]][2], mesh.nodes[side[0]][2]);  // outside on the right
  EXPECT_EQ(rim_nodes<2>(interface).size(), 2u);
  EXPECT_EQ(facet_nodes(interface).size(), 13u);
}

TEST(MeshKinds, RemovingMidEdgeNodesUndoesAddingThem) {
  const auto linear = test::short_artery();
  const auto back = without_mid_edge_nodes(with_mid_edge_nodes(linear));
  EXPECT_EQ(back.nodes, linear.nodes);
  EXPECT_EQ(back.cells, linear.cells);
  EXPECT_EQ(back.regions, linear.regions);
  ASSERT_EQ(back.facet_groups.size(), linear.facet_groups.size());
  for (std::size_t g = 0; g < back.facet_groups.size(); ++g)
    EXPECT_EQ(back.facet_groups[g].facets, linear.facet_groups[g].facets);
}

TEST(MeshKinds, RenumberingKeepsQuadraticMeshesAndNarrowsThem) {
  const auto mesh = with_mid_edge_nodes(test::coarse_artery());
  const auto order = reverse_cuthill_mckee(mesh);
  auto sorted = order.node_new_to_old;
  std::sort(sorted.begin(), sorted.end());
  ASSERT_EQ(sorted.size(), mesh.nodes.size());
  for (std::size_t n = 0; n < sorted.size(); ++n) EXPECT_EQ(sorted[n], static_cast<int>(n));
  const auto other = renumbered(mesh, order);
  EXPECT_LT(bandwidth(other), bandwidth(mesh) / 4);
  EXPECT_LT(bandwidth(other),
            10 * bandwidth(renumbered(test::coarse_artery(), reverse_cuthill_mckee(test::coarse_artery()))));
  const auto before = measure_quality(mesh), after = measure_quality(other);
  for (std::size_t r = 0; r < before.regions.size(); ++r) {
    EXPECT_NEAR(after.regions[r].volume, before.regions[r].volume, 1e-10);
    EXPECT_EQ(after.regions[r].layers, before.regions[r].layers);
  }
}

TEST(MeshKinds, QualityOfTriangles) {
  const std::array<Point, 3> regular{{{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}}};
  EXPECT_NEAR(mean_ratio(regular), 1, 1e-14);
  EXPECT_NEAR(smallest_angle(regular), 60, 1e-12);
  const std::array<Point, 3> turned{{regular[0], regular[2], regular[1]}};
  EXPECT_NEAR(mean_ratio(turned), -1, 1e-14);
  const auto quality = measure_quality(with_mid_edge_nodes(meridian_tube()));
  EXPECT_NEAR(quality.regions[0].volume, 3, 1e-13);
  EXPECT_NEAR(quality.regions[1].volume, 1.5, 1e-13);
  EXPECT_NEAR(quality.min_angle, std::atan(0.5) * 180 / M_PI, 1e-12);
  EXPECT_NEAR(quality.min_eta, 4 * std::sqrt(3.0) * 0.0625 / (0.25 * 0.25 * (1 + 4 + 5)), 1e-13);
  EXPECT_NEAR(quality.min_jacobian, 1, 1e-12);
  EXPECT_EQ(quality.regions[1].layers, 2);
  EXPECT_EQ(quality.regions[0].layers, 0);
  const auto text = to_text(quality);
  EXPECT_NE(text.find("72 quadratic triangles"), std::string::npos) << text;
  EXPECT_NE(text.find("smallest angle"), std::string::npos);
  EXPECT_TRUE(warnings_of(quality).empty());
}

TEST(MeshKinds, QualityOfCurvedCellsWarns) {
  SimplexMesh<2, 2> mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.72, 0, 0}, {0.5, 0.5, 0}, {0, 0.5, 0}};
  mesh.cells = {{0, 1, 2, 3, 4, 5}};
  mesh.cell_region = {0};
  mesh.regions = {"fluid"};
  const auto quality = measure_quality(mesh);
  EXPECT_NEAR(quality.min_jacobian, 1 - 4 * 0.22, 1e-12);  // see test_curved_cells.cpp
  const auto warnings = warnings_of(quality);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("least det J 0.120 of its mean"), std::string::npos) << warnings[0];
  // Beside a flat one that is not as bad the curved one is the worst, with an eta of its own: 4 sqrt(3) / 2 / 4.
  mesh.nodes.insert(mesh.nodes.end(),
                    {{2, 0, 0}, {3, 0, 0}, {2.5, 0.07, 0}, {2.5, 0, 0}, {2.75, 0.035, 0}, {2.25, 0.035, 0}});
  mesh.cells.push_back({6, 7, 8, 9, 10, 11});
  mesh.cell_region.push_back(0);
  const auto both = measure_quality(mesh);
  EXPECT_LT(both.min_eta, poor_eta);
  const std::string said = warnings_of(both).front();
  EXPECT_NE(said.find("fluid: 2 of 2 elements"), std::string::npos) << said;
  EXPECT_NE(said.find("the worst is triangle 1 near (0.33, 0.33, 0.00) mm, eta 0.866"), std::string::npos) << said;
}

TEST(MeshChecksInTwoDimensions, AcceptATubeOfBothOrders) {
  const auto mesh = meridian_tube();
  EXPECT_EQ(verdict(mesh, tube_needs()), "accepted");
  EXPECT_EQ(verdict(with_mid_edge_nodes(mesh), tube_needs()), "accepted");
}

TEST(MeshChecksInTwoDimensions, OutletIsOptionalAndTheWallIsHeldByItsAxis) {
  auto mesh = meridian_tube();
  group_of(mesh, "outlet").clear();
  EXPECT_EQ(verdict(mesh, tube_needs()),
            "mesh: outlet: the physical curve is missing or empty; name the sides of the fluid in gmsh, e.g. Physical "
            "Curve(\"outlet\") = {1};");
  auto needs = tube_needs();
  needs.outlet = false;
  EXPECT_EQ(verdict(mesh, needs), "accepted");
  needs.fluid = needs.inlet = false;  // a wall alone, clamped nowhere
  group_of(mesh, "wall_ends").clear();
  group_of(mesh, "symmetry_z").clear();
  EXPECT_EQ(verdict(mesh, needs), "accepted");
  needs.at_rest = true;  // along the axis only inertia holds it
  EXPECT_EQ(verdict(mesh, needs).substr(0, 57), "mesh: wall_ends: the physical curve is missing or empty; ");
  needs.holding = {"outer"};
  EXPECT_EQ(verdict(mesh, needs), "accepted");
  needs.holding = {};
  EXPECT_EQ(verdict(mesh, needs),
            "mesh: wall_ends: a piece of media with 24 triangles has no face that is held; connect it to the rest of "
            "the wall by shared facets, or clamp it");
}

TEST(MeshChecksInTwoDimensions, RimHasToBeHeld) {
  auto mesh = meridian_tube();
  group_of(mesh, "symmetry_z").clear();
  const auto message = verdict(mesh, tube_needs());
  EXPECT_EQ(
      message.substr(0, message.find(';')),
      "mesh: wall_ends: the rim of the interface is not clamped: 1 of its nodes are not in this group, the first at "
      "(1, 0, 3)");
}

TEST(MeshChecksInTwoDimensions, FindsCracksAndFoldedMeshes) {
  auto mesh = meridian_tube();
  auto cracked = mesh;
  test::split_off_first_region(cracked);
  EXPECT_NE(verdict(cracked, tube_needs()).find("two nodes in the same place, one of fluid and one of media"),
            std::string::npos);
  // Both ends of the wall's side stay where fluid and wall share them; between them it slides along the fluid's.
  auto hanging = mesh;
  std::vector<int> copy(mesh.nodes.size(), -1);
  for (std::size_t c = 0; c < hanging.cells.size(); ++c)
    for (int& node : hanging.cells[c]) {
      const Point x = mesh.nodes[node];
      if (hanging.cell_region[c] != 1 || x[0] != 1 || x[2] < 1 || x[2] > 2) continue;
      if (copy[node] < 0) {
        copy[node] = static_cast<int>(hanging.nodes.size());
        hanging.nodes.push_back({x[0], 0, x[2] + 0.1});
      }
      node = copy[node];
    }
  EXPECT_NE(verdict(hanging, tube_needs()).find("sides of fluid and media lie on each other"), std::string::npos)
      << verdict(hanging, tube_needs());
  std::swap(mesh.cells[0][1], mesh.cells[0][2]);
  EXPECT_NE(verdict(mesh, tube_needs()).find("lie on the same side: the mesh is folded"), std::string::npos);
}

TEST(MeshChecksInTwoDimensions, SymmetryPlanesAreNormalToTheirAxis) {
  auto mesh = meridian_tube();
  mesh.facet_groups.push_back({"symmetry_x", *mesh.facets("symmetry_z")});
  EXPECT_EQ(
      verdict(mesh, tube_needs()),
      "mesh: symmetry_x: the edge at (1.125, 0, 3) does not lie in a plane normal to x: its nodes are 0.25 mm "
      "apart along it; put flat faces normal to this axis only into this group, and other planes into symmetry_1, "
      "symmetry_2 and so on");
  mesh.facet_groups.back().name = "symmetry_y";
  EXPECT_EQ(verdict(mesh, tube_needs()).substr(0, 54), "mesh: symmetry_y: the mesh lies in this plane itself; ");
}

TEST(MeshChecksInTwoDimensions, PlanesOfABodyOfRevolutionAreNormalToItsAxis) {
  auto mesh = meridian_tube();
  for (auto& group : mesh.facet_groups)
    if (group.name == "symmetry_z") group.name = "symmetry_1";
  EXPECT_EQ(verdict(mesh, tube_needs()), "accepted");
  for (auto& x : mesh.nodes)
    if (x[2] == 3) x[2] += 0.2 * x[0];
  EXPECT_EQ(
      verdict(mesh, tube_needs()),
      "mesh: symmetry_1: its sides are not normal to the axis: turned about it they are no plane; put sides of one "
      "height only into this group");
}

TEST(SymmetryPlanes, FacetsTellTheNormal) {
  const auto mesh = generate_artery(ArteryShape{}, ArteryCells{}, 60);
  auto needs = tube_needs();
  needs.layers.push_back("adventitia");
  const auto normal_of = [&](const std::string& name) {
    for (const auto& plane : symmetry_planes(mesh))
      if (plane.group->name == name) return plane.normal;
    return Point{};
  };
  EXPECT_EQ(symmetry_planes(mesh).size(), 2u);
  EXPECT_EQ(normal_of("symmetry_y"), (Point{0, 1, 0}));
  const Point normal = normal_of("symmetry_1");
  EXPECT_NEAR(std::abs(normal[0]), std::sqrt(0.75), 1e-15);
  EXPECT_NEAR(normal[1], -normal[0] / std::sqrt(3), 1e-15);
  EXPECT_EQ(normal[2], 0);
  EXPECT_EQ(verdict(mesh, needs), "accepted");

  // Two planes in one group are none.
  auto both = mesh;
  for (auto& group : both.facet_groups)
    if (group.name == "symmetry_1")
      group.facets.insert(group.facets.end(), mesh.facets("symmetry_y")->begin(), mesh.facets("symmetry_y")->end());
  const auto message = verdict(both, needs);
  EXPECT_EQ(message.substr(0, 68), "mesh: symmetry_1: its triangles do not lie in one plane: the one at ");
  EXPECT_NE(message.find(" mm off their mean plane; put each plane into a group of its own: symmetry_1, symmetry_2 and "
                         "so on"),
            std::string::npos)
      << message;
}

TEST(MeshChecks, RefuseFoldedCurvedCells) {
  auto mesh = with_mid_edge_nodes(meridian_tube());
  EXPECT_EQ(verdict(mesh, tube_needs()), "accepted");
  auto& x = mesh.nodes[mesh.cells[5][3]];
  x[0] += 0.2;
  EXPECT_NE(verdict(mesh, tube_needs()).find("folded by its curved edges"), std::string::npos);
}

TEST(MeshChecks, SymmetryPlanesHoldABox) {
  auto mesh = test::fluid_and_wall_box(2);
  SceneMeshNeeds needs = tube_needs();
  needs.layers = {"media", "adventitia"};
  const auto holds = [](int axis) { return [axis](const Point& x) { return x[axis] == 0 || x[axis] == 1; }; };
  auto& ends = *std::find_if(mesh.facet_groups.begin(), mesh.facet_groups.end(),
                             [](auto& group) { return group.name == "wall_ends"; });
  ends.facets.clear();
  EXPECT_EQ(verdict(mesh, needs).substr(0, 59), "mesh: wall_ends: the physical surface is missing or empty; ");
  for (const int axis : {0, 1}) {
    mesh.facet_groups.push_back({axis == 0 ? "symmetry_x" : "symmetry_y", {}});
    for (const char* region : {"fluid", "media", "adventitia"}) {
      if (axis == 0 && std::string(region) == "fluid") continue;  // inlet and outlet
      for (const auto& facet : test::facets_where(mesh, region, holds(axis)))
        mesh.facet_groups.back().facets.push_back(facet);
    }
  }
  EXPECT_EQ(verdict(mesh, needs), "accepted");
  EXPECT_EQ(verdict(with_mid_edge_nodes(mesh), needs), "accepted");
}

}  // namespace
}  // namespace fsi
