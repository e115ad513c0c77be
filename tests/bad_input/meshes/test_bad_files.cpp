// Files that are not a readable mesh: each is refused with one message that says where and what to do.

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "mesh_io/gmsh_reader.hpp"
#include "tiny_tube.hpp"

namespace fsi::test {
namespace {

/// The text with the first occurrence of `from` replaced.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string message_of_path(const std::filesystem::path& path) {
  try {
    read_gmsh(path, {"fluid"});
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(BadFile, TheTubeItselfIsFine) {
  EXPECT_EQ(verdict(tiny_tube().text_41()), "accepted");
  EXPECT_EQ(verdict(tiny_tube().text_22()), "accepted");
  EXPECT_EQ(verdict(tiny_tube().binary_41()), "accepted");
  EXPECT_EQ(verdict(tiny_tube().binary_22()), "accepted");
}

TEST(BadFile, WindowsLineEndsAreFine) {
  std::string text;
  for (const char c : tiny_tube().text_41()) text += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(verdict(text), "accepted");
}

TEST(BadFile, Missing) {
  EXPECT_EQ(message_of_path("no-such.msh"),
            "no-such.msh: there is no such mesh file; check the path, or make one: fsi-mesh artery --level coarse -o "
            "FILE.msh");
}

TEST(BadFile, Folder) {
  const ScratchFile file("");
  EXPECT_EQ(message_of_path(file.path().parent_path()),
            file.path().parent_path().string() + ": is a folder; give the path of a gmsh .msh file");
}

TEST(BadFile, Device) {
  EXPECT_EQ(message_of_path("/dev/zero"),
            "/dev/zero: is a pipe, socket or device, not a file; give the path of a gmsh .msh file");
}

TEST(BadFile, LongName) {
  EXPECT_EQ(verdict(replaced(tiny_tube().text_22(), "\"fluid\"", "\"" + std::string(128, 'x') + "\"")),
            "tube.msh: $PhysicalNames: a physical name of 128 bytes; give at most 127");
}

TEST(BadFile, TextBetweenSections) {
  EXPECT_EQ(verdict("$MeshFormat\n4.1 0 8\n$EndMeshFormat\nNodes\n"),
            "tube.msh: $MeshFormat: expected the begin of a section at line 4, found 'Nodes'; the file is truncated or "
            "damaged; write it again with gmsh");
}

TEST(BadFile, Empty) {
  EXPECT_EQ(verdict(""),
            "tube.msh: $MeshFormat: is not a gmsh .msh file of version 4.1 or 2.2: it does not begin with $MeshFormat; "
            "write it with gmsh, Mesh.MshFileVersion = 4.1");
}

TEST(BadFile, SomethingElse) {
  EXPECT_EQ(verdict("solid tube\nfacet normal 0 0 1\n"),
            "tube.msh: $MeshFormat: is not a gmsh .msh file of version 4.1 or 2.2: it does not begin with $MeshFormat; "
            "write it with gmsh, Mesh.MshFileVersion = 4.1");
}

TEST(BadFile, VersionOne) {
  EXPECT_EQ(verdict("$NOD\n0\n$ENDNOD\n"),
            "tube.msh: $MeshFormat: is not a gmsh .msh file of version 4.1 or 2.2: it does not begin with $MeshFormat; "
            "write it with gmsh, Mesh.MshFileVersion = 4.1");
}

TEST(BadFile, UnsupportedVersion) {
  EXPECT_EQ(verdict(replaced(tiny_tube().text_41(), "4.1 0 8", "4 0 8")),
            "tube.msh: $MeshFormat: version 4 is not supported; write 4.1 or 2.2: Mesh.MshFileVersion = 4.1");
}

TEST(BadFile, OtherDataSize) {
  EXPECT_EQ(verdict(replaced(tiny_tube().text_41(), "4.1 0 8", "4.1 0 4")),
            "tube.msh: $MeshFormat: data size is 4; write the file on a 64-bit machine, with size 8");
}

TEST(BadFile, OtherByteOrder) {
  const std::string mark("\1\0\0\0", 4), swapped("\0\0\0\1", 4);
  EXPECT_EQ(verdict(replaced(tiny_tube().binary_41(), mark, swapped)),
            "tube.msh: $MeshFormat: binary data of the other byte order; write the file as ASCII: Mesh.Binary = 0");
}

TEST(BadFile, TruncatedText) {
  const auto text = tiny_tube().text_41();
  EXPECT_EQ(
      verdict(text.substr(0, text.find("$EndNodes"))),
      "tube.msh: $Nodes: the file ends before $EndNodes; the file is truncated or damaged; write it again with gmsh");
}

TEST(BadFile, TruncatedBinary) {
  const auto data = tiny_tube().binary_41();
  const auto cut = data.find("$EndNodes") - 9;                     // in the last coordinate
  const auto block = data.find("$Nodes") + 7 + 4 * 8 + 3 * 4 + 8;  // behind the head of the only block
  EXPECT_EQ(verdict(data.substr(0, cut)),
            "tube.msh: $Nodes: the number of nodes in a block is 48 at byte " + std::to_string(block) + ", but only " +
                std::to_string(cut - block) +
                " bytes are left; the file is truncated or damaged; write it again with gmsh");
}

TEST(BadFile, NoElements) {
  const auto text = tiny_tube().text_41();
  EXPECT_EQ(
      verdict(text.substr(0, text.find("$Elements"))),
      "tube.msh: $Elements: the file has no such section; the file is truncated or damaged; write it again with gmsh");
}

TEST(BadFile, CountThatCannotBe) {
  EXPECT_EQ(verdict(replaced(tiny_tube().text_22(), "$Nodes\n48\n", "$Nodes\n4000000000000\n")).substr(0, 60),
            "tube.msh: $Nodes: the number of nodes is 4000000000000 at li");
  EXPECT_EQ(verdict(replaced(tiny_tube().text_22(), "$Nodes\n48\n", "$Nodes\n-1\n")).substr(0, 45),
            "tube.msh: $Nodes: the number of nodes is -1 a");
}

TEST(BadFile, CountThatDoesNotFit) {
  EXPECT_EQ(
      verdict(replaced(tiny_tube().text_22(), "$Nodes\n48\n", "$Nodes\n47\n")),
      "tube.msh: $Nodes: expected $EndNodes at line 62, found '48 3 3 2?$EndNodes?$Elem'; the file is truncated or "
      "damaged; write it again with gmsh");
  EXPECT_EQ(
      verdict(replaced(tiny_tube().text_41(), "$Nodes\n1 48", "$Nodes\n1 49")),
      "tube.msh: $Nodes: 49 nodes announced, 48 found; the file is truncated or damaged; write it again with gmsh");
}

TEST(BadFile, WordForANumber) {
  EXPECT_EQ(
      verdict(replaced(tiny_tube().text_22(), "\n1 0 0 0\n", "\n1 0 zero 0\n")),
      "tube.msh: $Nodes: expected a coordinate at line 15, found 'zero'; the file is truncated or damaged; write it "
      "again with gmsh");
}

TEST(BadFile, CoordinateNotANumber) {
  EXPECT_EQ(verdict(replaced(tiny_tube().text_22(), "\n1 0 0 0\n", "\n1 0 nan 0\n")),
            "tube.msh: $Nodes: coordinate is nan at line 15; give coordinates up to 1e+30 mm");
  EXPECT_EQ(verdict(replaced(tiny_tube().text_22(), "\n1 0 0 0\n", "\n1 0 1e999 0\n")),
            "tube.msh: $Nodes: coordinate is inf at line 15; give coordinates up to 1e+30 mm");
  EXPECT_EQ(verdict(replaced(tiny_tube().text_22(), "\n1 0 0 0\n", "\n1 0 1e31 0\n")),
            "tube.msh: $Nodes: coordinate is 1e+31 at line 15; give coordinates up to 1e+30 mm");
}

TEST(BadFile, UnknownNode) {
  auto file = tiny_tube();
  file.elements.back().nodes[2] = 1000;
  for (const auto& content : {file.text_41(), file.binary_22()})
    EXPECT_EQ(verdict(content), "tube.msh: element " + std::to_string(file.elements.size()) +
                                    ": node 1000 does not exist; write the file again with gmsh");
}

TEST(BadFile, RepeatedNodeTag) {
  auto file = tiny_tube();
  file.nodes[7].tag = 5;
  for (const auto& content : {file.text_41(), file.text_22()})
    EXPECT_EQ(verdict(content), "tube.msh: $Nodes: node tag 5 appears twice; give every node a tag of its own");
}

TEST(BadFile, UnusedNodes) {
  auto file = tiny_tube();
  file.nodes.push_back({60, {9, 9, 9}});
  file.nodes.push_back({61, {8, 9, 9}});
  EXPECT_EQ(
      verdict(file.text_41()),
      "tube.msh: $Nodes: unused nodes: 2 in no element, the first is node 60; remove them, e.g. in gmsh by Coherence "
      "Mesh and saving without Mesh.SaveAll");
}

TEST(BadFile, NoPhysicalNames) {
  auto file = tiny_tube();
  file.names.clear();
  EXPECT_EQ(verdict(file.text_41()),
            "tube.msh: $PhysicalNames: the file names no physical groups; name the volumes in gmsh, e.g. Physical "
            "Volume(\"fluid\") = {1};");
}

TEST(BadFile, MissingVolume) {
  auto needs = tube_needs();
  needs.layers = {"meda"};
  EXPECT_EQ(verdict(tiny_tube().text_41(), needs),
            "tube.msh: meda: there is no physical volume of this name; nearest: media; the file has fluid, media");
}

TEST(BadFile, EmptyVolume) {
  auto file = tiny_tube();
  for (auto& element : file.elements)
    if (element.physical == std::vector<int>{media_tag}) element.physical = {fluid_tag};
  EXPECT_EQ(
      verdict(file.text_41()),
      "tube.msh: media: the physical volume is empty: no element belongs to it; assign the volume's entities to the "
      "group, mesh in three dimensions, and save without Mesh.SaveAll");
}

TEST(BadFile, ElementInTwoVolumes) {
  auto file = tiny_tube();
  const auto element = file.of_group(media_tag).front();
  file.elements[element].physical = {fluid_tag, media_tag};
  for (const auto& content : {file.text_41(), file.text_22()})
    EXPECT_EQ(verdict(content), "tube.msh: fluid: element " + std::to_string(element + 1) +
                                    " is in volume media, too; put every element into one physical volume only");
}

TEST(BadFile, ElementListedTwice) {
  auto file = tiny_tube();
  file.elements.push_back(file.elements.back());
  const auto count = file.elements.size();
  EXPECT_EQ(verdict(file.text_41()), "tube.msh: media: elements " + std::to_string(count - 1) + " and " +
                                         std::to_string(count) + " have the same nodes; remove one of them");
}

TEST(BadFile, TetrahedraOfBothOrders) {
  auto file = tiny_tube();
  const auto element = file.of_group(fluid_tag)[1], first = file.of_group(media_tag).front();
  auto& curved = file.elements[element];
  curved.type = 11;
  curved.nodes.insert(curved.nodes.end(), {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(verdict(file.text_22()), "tube.msh: fluid: element " + std::to_string(element + 1) +
                                         " is of second order, element " + std::to_string(first + 1) +
                                         " of first: the mesh mixes both; save all of them with one Mesh.ElementOrder, "
                                         "1 or 2");
  EXPECT_NE(verdict(file.binary_41()).find("the mesh mixes both"), std::string::npos);
}

TEST(BadFile, ThirdOrderTetrahedra) {
  auto file = tiny_tube();
  const auto element = file.of_group(fluid_tag).front();
  file.elements[element].type = 29;
  file.elements[element].nodes.resize(20, 1);
  EXPECT_EQ(verdict(file.text_22()), "tube.msh: fluid: element " + std::to_string(element + 1) +
                                         " and 0 more are third-order tetrahedra (type 29); save tetrahedra of first "
                                         "or second order: Mesh.ElementOrder = 1 or 2");
}

TEST(BadFile, Hexahedra) {
  auto file = tiny_tube();
  const auto element = file.of_group(media_tag).front();
  file.elements[element].type = 5;
  file.elements[element].nodes = {1, 2, 6, 5, 17, 18, 22, 21};
  EXPECT_EQ(verdict(file.text_41()), "tube.msh: media: element " + std::to_string(element + 1) +
                                         " and 0 more are hexahedra (type 5); mesh with tetrahedra only, without "
                                         "Recombine or layers of prisms");
}

TEST(BadFile, UnknownElementType) {
  auto file = tiny_tube();
  file.elements.back().type = 77;
  EXPECT_EQ(verdict(file.text_22()),
            "tube.msh: $Elements: unknown element type 77; mesh with tetrahedra and triangles (types 4 and 2)");
}

TEST(BadFile, InvertedTetrahedron) {
  auto file = tiny_tube();
  const auto element = file.of_group(media_tag).front();
  std::swap(file.elements[element].nodes[0], file.elements[element].nodes[1]);
  EXPECT_EQ(verdict(file.text_41()),
            "tube.msh: element " + std::to_string(element + 1) +
                " of media: inverted tetrahedron, volume -0.166667 mm^3; order its nodes so that "
                "the volume is positive, or mesh again");
}

TEST(BadFile, AllTetrahedraInverted) {
  auto file = tiny_tube();
  for (auto& element : file.elements)
    if (element.type == 4) std::swap(element.nodes[0], element.nodes[1]);
  EXPECT_NE(verdict(file.binary_41()).find("inverted tetrahedron, volume -0.166667 mm^3"), std::string::npos);
}

TEST(BadFile, FlatTetrahedron) {
  auto file = tiny_tube();
  const auto element = file.of_group(fluid_tag).front();
  file.elements[element].nodes[3] = file.elements[element].nodes[2];
  EXPECT_EQ(verdict(file.text_41()),
            "tube.msh: element " + std::to_string(element + 1) +
                " of fluid: degenerate tetrahedron, volume 0 mm^3 with edges up to 1.41421 mm; "
                "mesh again, with Mesh.Optimize = 1");
}

TEST(BadFile, Partitioned) {
  EXPECT_EQ(
      verdict(
          replaced(tiny_tube().text_41(), "$Nodes\n", "$PartitionedEntities\n2\n$EndPartitionedEntities\n$Nodes\n")),
      "tube.msh: $PartitionedEntities: a partitioned mesh; save it whole: Mesh.PartitionCreateTopology = 0, without "
      "partitions");
}

TEST(BadFile, EntityNotListed) {
  EXPECT_EQ(verdict(replaced(tiny_tube().text_41(), "\n3 5 4 ", "\n3 99 4 ")),
            "tube.msh: $Elements: elements of entity 99 of dimension 3, which $Entities does not list; the file is "
            "truncated or damaged; write it again with gmsh");
}

TEST(BadFile, SectionTwice) {
  const auto text = tiny_tube().text_22();
  EXPECT_EQ(
      verdict(text + text.substr(text.find("$Elements"))),
      "tube.msh: $Elements: a second section of this name; the file is truncated or damaged; write it again with gmsh");
}

TEST(BadFile, OtherSectionsArePassedOver) {
  EXPECT_EQ(verdict(replaced(tiny_tube().text_22(), "$Nodes\n", "$Comments\n$ not a mesh\n$EndComments\n$Nodes\n")),
            "accepted");
}

}  // namespace
}  // namespace fsi::test
