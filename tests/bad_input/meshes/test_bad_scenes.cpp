// Readable meshes on which a scene cannot be computed.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "tiny_tube.hpp"

namespace fsi::test {
namespace {

/// Takes all elements of a group out of the file.
void remove_group(TinyFile& file, int tag) {
  auto& elements = file.elements;
  elements.erase(std::remove_if(elements.begin(), elements.end(),
                                [&](const auto& element) { return element.physical == std::vector<int>{tag}; }),
                 elements.end());
}

TEST(BadScene, InletMissing) {
  auto file = tiny_tube();
  remove_group(file, inlet_tag);
  EXPECT_EQ(
      verdict(file.text_41()),
      "tube.msh: inlet: the physical surface is missing or empty; name the faces of the fluid in gmsh, e.g. Physical "
      "Surface(\"inlet\") = {1};");
}

TEST(BadScene, OutletHasAnotherName) {
  auto file = tiny_tube();
  file.names[1].name = "outflow";
  EXPECT_EQ(
      verdict(file.text_22()),
      "tube.msh: outlet: the physical surface is missing or empty; if outflow is meant, rename it, or add [[opening]] "
      "with surface = \"outflow\", or name the faces of the fluid in gmsh, e.g. Physical Surface(\"outlet\") = {1};");
}

TEST(BadScene, WallEndsHaveAnotherName) {
  auto file = tiny_tube();
  file.names[2].name = "ends";
  EXPECT_EQ(
      verdict(file.text_22()),
      "tube.msh: wall_ends: the physical surface is missing or empty; if ends is meant, rename it, or add [[support]] "
      "with surface = \"ends\" and fixed = [\"x\", \"y\", \"z\"], or name the faces of the wall in gmsh, e.g. "
      "Physical Surface(\"wall_ends\") = {1};");
}

TEST(BadScene, WallEndsMissing) {
  auto file = tiny_tube();
  remove_group(file, wall_ends_tag);
  EXPECT_EQ(verdict(file.text_41()),
            "tube.msh: wall_ends: the physical surface is missing or empty; name the faces of the wall in gmsh, e.g. "
            "Physical Surface(\"wall_ends\") = {1};");
}

TEST(BadScene, OuterIsOptional) {
  auto file = tiny_tube();
  remove_group(file, outer_tag);
  EXPECT_EQ(verdict(file.text_41()), "accepted");
}

TEST(BadScene, FluidAloneNeedsNoWallGroups) {
  auto file = tiny_tube();
  remove_group(file, wall_ends_tag);
  auto needs = tube_needs();
  needs.layers.clear();
  EXPECT_EQ(verdict(file.text_41(), needs), "accepted");
}

TEST(BadScene, WallAloneNeedsInner) {
  SceneMeshNeeds needs;
  needs.layers = {"media"};
  needs.inner_surface = true;
  EXPECT_EQ(
      verdict(tiny_tube().text_41(), needs),
      "tube.msh: inner: the physical surface is missing or empty; name the faces of the wall in gmsh, e.g. Physical "
      "Surface(\"inner\") = {1};");
}

TEST(BadScene, InletOnTheWall) {
  auto file = tiny_tube();
  file.elements[file.of_group(wall_ends_tag).front()].physical = {inlet_tag};
  EXPECT_EQ(
      verdict(file.text_41()),
      "tube.msh: inlet: 1 of 3 triangles do not bound the fluid, the first at (0.666667, 0.333333, 0); put faces of "
      "the fluid only into this group");
}

TEST(BadScene, SurfaceInsideTheFluid) {
  auto file = tiny_tube();
  const auto tetrahedron = file.of_group(fluid_tag).front();
  const auto& nodes = file.elements[tetrahedron].nodes;
  file.elements.push_back({2, {inlet_tag}, {nodes[0], nodes[1], nodes[3]}});
  EXPECT_NE(verdict(file.text_41()).find("tube.msh: inlet: 1 of 3 triangles lie between two tetrahedra, the first at "),
            std::string::npos);
}

TEST(BadScene, SurfaceTriangleIsNoFacet) {
  auto file = tiny_tube();
  file.elements.push_back({2, {inlet_tag}, {tube_node(1, 1, 0), tube_node(2, 1, 0), tube_node(1, 2, 2)}});
  EXPECT_EQ(verdict(file.text_41()), "tube.msh: inlet: element " + std::to_string(file.elements.size()) +
                                         " (triangles) is no facet of a tetrahedron; save surfaces and volumes of one "
                                         "conforming mesh of triangles and tetrahedra");
}

/// Of a surface of any name, where the case uses it.
TEST(BadScene, TriangleOfAnOpeningOrSupportIsNoFacet) {
  auto file = tiny_tube();
  file.names[0].name = "lca";
  file.names[3].name = "tissue";
  const std::vector<std::int64_t> nodes{tube_node(1, 1, 0), tube_node(2, 1, 0), tube_node(1, 2, 2)};
  for (const int tag : {inlet_tag, outer_tag}) {
    auto changed = file;
    changed.elements.push_back({2, {tag}, nodes});
    auto needs = tube_needs();
    needs.inlet = false;
    needs.openings = {"outlet"};
    EXPECT_EQ(verdict(changed.text_41(), needs), "accepted");
    needs.openings.emplace_back("lca");
    needs.supports = {"tissue"};
    EXPECT_EQ(
        verdict(changed.text_22(), needs),
        fmt::format("tube.msh: {}: element {} (triangles) is no facet of a tetrahedron; save surfaces and volumes "
                    "of one conforming mesh",
                    tag == inlet_tag ? "lca" : "tissue", changed.elements.size()));
  }
}

TEST(BadScene, SurfaceTriangleTwice) {
  auto file = tiny_tube();
  const auto triangle = file.of_group(outlet_tag).front();
  file.elements.push_back(file.elements[triangle]);
  EXPECT_EQ(verdict(file.text_41()), "tube.msh: outlet: triangles " + std::to_string(triangle + 1) + " and " +
                                         std::to_string(file.elements.size()) +
                                         " have the same nodes; remove one of them");
}

TEST(BadScene, TriangleInInletAndOutlet) {
  auto file = tiny_tube();
  file.elements[file.of_group(inlet_tag).front()].physical = {inlet_tag, outlet_tag};
  EXPECT_NE(verdict(file.text_41()).find("is in inlet, too; put every face into one of the two groups only"),
            std::string::npos);
}

TEST(BadScene, FurtherGroupsAreIgnored) {
  auto file = tiny_tube();
  file.names.push_back({2, 77, "probe"});
  file.names.push_back({3, 78, "tissue"});
  file.nodes.push_back({100, {0, 0, 9}});
  file.elements.push_back({2, {77}, {tube_node(0, 0, 0), tube_node(3, 3, 2), 100}});
  file.elements.push_back({4, {78}, {tube_node(0, 0, 2), tube_node(1, 0, 2), tube_node(0, 1, 2), 100}});
  EXPECT_EQ(verdict(file.text_41()), "accepted");
  EXPECT_EQ(verdict(file.binary_22()), "accepted");
}

TEST(BadScene, FacetOfThreeTetrahedra) {
  auto file = tiny_tube();
  // A third tetrahedron on a facet in the middle of the fluid, with a point of its own.
  file.nodes.push_back({100, {1.9, 1.45, 0.6}});
  const auto nodes = file.elements[file.of_group(fluid_tag).front()].nodes;
  file.elements.push_back({4, {fluid_tag}, {nodes[0], nodes[1], nodes[3], 100}});
  auto message = verdict(file.text_41());
  if (message.find("inverted") != std::string::npos) {
    std::swap(file.elements.back().nodes[0], file.elements.back().nodes[1]);
    message = verdict(file.text_41());
  }
  EXPECT_NE(message.find("3 tetrahedra share it; a facet has one or two; remove overlapping volumes and mesh again"),
            std::string::npos)
      << message;
}

TEST(BadScene, FoldedMesh) {
  auto file = tiny_tube();
  // A flap on the outside of the wall that is laid inwards, over the tetrahedron behind the same facet.
  const auto triangle = file.elements[file.of_group(outer_tag).front()].nodes;
  file.nodes.push_back({100, {0.4, 0.45, 0.5}});
  file.elements.push_back({4, {media_tag}, {triangle[0], triangle[1], triangle[2], 100}});
  remove_group(file, outer_tag);
  auto message = verdict(file.text_41());
  if (message.find("inverted") != std::string::npos) {
    std::swap(file.elements.back().nodes[0], file.elements.back().nodes[1]);
    message = verdict(file.text_41());
  }
  EXPECT_NE(
      message.find("its two tetrahedra (in media and media) lie on the same side: the mesh is folded; mesh again, "
                   "with smaller elements where layers are thin"),
      std::string::npos)
      << message;
}

TEST(BadScene, FluidAndWallHaveTheirOwnNodes) {
  auto file = tiny_tube();
  file.detach(
      {fluid_tag, inlet_tag, outlet_tag}, [](const Point&) { return true; }, [](const Point& x) { return x; });
  EXPECT_NE(
      verdict(file.text_41())
          .find("two nodes in the same place, one of media and one of fluid: the mesh is not conforming; mesh fluid "
                "and wall together, with one shared surface (gmsh: BooleanFragments or Coherence before meshing)"),
      std::string::npos);
}

TEST(BadScene, FluidAndWallShareNoFacet) {
  auto file = tiny_tube();
  file.detach(
      {fluid_tag, inlet_tag, outlet_tag}, [](const Point&) { return true; },
      [](const Point& x) {
        return Point{1.5 + 0.8 * (x[0] - 1.5), 1.5 + 0.8 * (x[1] - 1.5), x[2]};
      });
  EXPECT_EQ(
      verdict(file.text_41()),
      "tube.msh: interface: the wall does not touch the fluid: they share no facet; mesh fluid and wall together, "
      "with one shared surface (gmsh: BooleanFragments or Coherence before meshing)");
}

TEST(BadScene, HangingNodesOnTheInterface) {
  auto file = tiny_tube();
  // The wall's middle nodes on the face x = 2 move along it: there both sides meet without sharing facets.
  file.detach(
      {media_tag, outer_tag}, [](const Point& x) { return x[0] == 2 && x[1] >= 1 && x[1] <= 2 && x[2] == 1; },
      [](const Point& x) {
        return Point{x[0], x[1], x[2] + 0.1};
      });
  const auto message = verdict(file.text_41());
  EXPECT_NE(
      message.find("faces of fluid and media lie on each other without sharing nodes (hanging nodes); mesh fluid and "
                   "wall together"),
      std::string::npos)
      << message;
}

TEST(BadScene, RimNotClamped) {
  auto file = tiny_tube();
  auto& elements = file.elements;
  elements.erase(std::remove_if(elements.begin(), elements.end(),
                                [](const auto& element) {
                                  return element.physical == std::vector<int>{wall_ends_tag} && element.nodes[0] > 32;
                                }),
                 elements.end());
  EXPECT_EQ(
      verdict(file.text_41()),
      "tube.msh: wall_ends: the rim of the interface is not clamped: 4 of its nodes are not in this group, the first "
      "at (1, 1, 2); put both end faces of all wall layers into it, or planes of symmetry into symmetry_x, symmetry_y, "
      "symmetry_z, or symmetry_1 and so on");
}

/// A volume of the wall that the case does not name is no part of what is read: the rim ends where it begins.
TEST(BadScene, RimEndsAtAVolumeThatIsLeftOut) {
  auto file = tiny_tube();
  file.names.push_back({3, 78, "plaque"});
  const auto wall = file.of_group(media_tag);
  const auto at_end = [&](std::size_t element) {
    const auto& nodes = file.elements[element].nodes;
    return std::all_of(nodes.begin(), nodes.end(), [&](auto tag) { return file.nodes[tag - 1].x[2] >= 1; });
  };
  for (const auto element : wall)
    if (at_end(element)) file.elements[element].physical = {78};
  auto needs = tube_needs();
  needs.left_out = {"plaque"};
  const auto message = verdict(file.text_41(), needs);
  EXPECT_NE(message.find("wall_ends: the rim of the interface is not clamped"), std::string::npos) << message;
  EXPECT_NE(
      message.find("give plaque of the mesh, which the case leaves out, a section [structure.layers.plaque], or "),
      std::string::npos)
      << message;
}

TEST(BadScene, FluidInTwoPieces) {
  auto file = tiny_tube();
  for (const auto element : file.of_group(media_tag)) {
    bool corner = true;  // the cube at the origin, away from the fluid but for an edge
    for (const auto tag : file.elements[element].nodes) {
      const Point& x = file.nodes[tag - 1].x;
      corner = corner && x[0] <= 1 && x[1] <= 1 && x[2] <= 1;
    }
    if (corner) file.elements[element].physical = {fluid_tag};
  }
  remove_group(file, outer_tag);
  std::vector<std::size_t> at_inlet;
  for (const auto element : file.of_group(wall_ends_tag)) {
    bool corner = true;
    for (const auto tag : file.elements[element].nodes) {
      const Point& x = file.nodes[tag - 1].x;
      corner = corner && x[0] <= 1 && x[1] <= 1 && x[2] == 0;
    }
    if (corner) file.elements[element].physical = {inlet_tag};
  }
  EXPECT_EQ(
      verdict(file.text_41()),
      "tube.msh: fluid: the volume is in 2 pieces that share no facet, the largest of 12 and 6 tetrahedra; connect "
      "them, or leave the smaller ones out of the group");
}

TEST(BadScene, WallPieceHeldNowhere) {
  auto file = tiny_tube();
  const auto base = static_cast<std::int64_t>(file.nodes.size());
  for (const Point& x : {Point{5, 0, 0}, Point{6, 0, 0}, Point{5, 1, 0}, Point{5, 0, 1}})
    file.nodes.push_back({static_cast<std::int64_t>(file.nodes.size()) + 1, x});
  file.elements.push_back({4, {media_tag}, {base + 1, base + 2, base + 3, base + 4}});
  EXPECT_EQ(
      verdict(file.text_41()),
      "tube.msh: wall_ends: a piece of media with 1 tetrahedra has no face in this group; connect it to the rest of "
      "the wall by shared facets, or clamp it");
}

}  // namespace
}  // namespace fsi::test
