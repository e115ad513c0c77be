#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/error.hpp"
#include "mesh/facets.hpp"
#include "mesh/point_math.hpp"
#include "mesh_io/gmsh_reader.hpp"
#include "mesh_io/gmsh_writer.hpp"
#include "meshes.hpp"

namespace fsi {
namespace {

class GmshFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("gmsh_files_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static std::string bytes(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  std::filesystem::path folder_;
};

TEST_F(GmshFiles, AllFourFormatsGiveTheSameMesh) {
  // The generator lists cells station by station, a file region by region: compare what has been through a file.
  const auto made = test::short_artery();
  const std::vector<std::string> volumes{"fluid", "media", "adventitia"};
  TetrahedralMesh first;
  for (const auto& format :
       {GmshFormat{"4.1", false}, GmshFormat{"4.1", true}, GmshFormat{"2.2", false}, GmshFormat{"2.2", true}}) {
    SCOPED_TRACE(format.version + (format.binary ? " binary" : " ASCII"));
    const auto file = folder_ / "tube.msh";
    write_gmsh(made, file, format);
    const auto mesh = read_gmsh(file, volumes);
    if (first.nodes.empty()) first = mesh;
    ASSERT_EQ(mesh.nodes.size(), made.nodes.size());
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)  // gmsh prints 16 digits, one short of all
      EXPECT_NEAR(distance(mesh.nodes[n], made.nodes[n]), 0, format.binary ? 0 : 1e-15);
    EXPECT_EQ(mesh.cells, first.cells);
    EXPECT_EQ(mesh.cell_region, first.cell_region);
    EXPECT_EQ(mesh.regions, volumes);
    ASSERT_EQ(mesh.facet_groups.size(), 4u);
    for (const auto& group : made.facet_groups) {
      const auto* facets = mesh.facets(group.name);
      ASSERT_NE(facets, nullptr) << group.name;
      ASSERT_EQ(facets->size(), group.facets.size());
      for (std::size_t f = 0; f < facets->size(); ++f)
        EXPECT_EQ(facet_key((*facets)[f]), facet_key(group.facets[f])) << group.name;
    }
  }
  ASSERT_EQ(first.cells.size(), made.cells.size());
}

TEST_F(GmshFiles, SameMeshGivesSameBytes) {
  write_gmsh(test::short_artery(), folder_ / "a.msh", {"4.1", true});
  write_gmsh(test::short_artery(), folder_ / "b.msh", {"4.1", true});
  EXPECT_EQ(bytes(folder_ / "a.msh"), bytes(folder_ / "b.msh"));
}

TEST_F(GmshFiles, FacetsPointOutOfTheirCells) {
  write_gmsh(test::short_artery(), folder_ / "tube.msh", {});
  const auto mesh = read_gmsh(folder_ / "tube.msh", {"fluid", "media", "adventitia"});
  const auto area = [&](const auto& f) {
    return triangle_area_vector(mesh.nodes[f[0]], mesh.nodes[f[1]], mesh.nodes[f[2]]);
  };
  for (const auto& facet : *mesh.facets("inlet")) EXPECT_LT(area(facet)[2], 0);
  for (const auto& facet : *mesh.facets("outlet")) EXPECT_GT(area(facet)[2], 0);
  for (const auto& facet : *mesh.facets("outer")) EXPECT_GT(dot(area(facet), mesh.nodes[facet[0]]), 0);
}

TEST_F(GmshFiles, LeavesOutVolumesThatAreNotWanted) {
  const auto made = test::short_artery();
  write_gmsh(made, folder_ / "tube.msh", {});
  const auto fluid = read_gmsh(folder_ / "tube.msh", {"fluid"});
  EXPECT_EQ(fluid.cells.size(),
            static_cast<std::size_t>(std::count(made.cell_region.begin(), made.cell_region.end(), 0)));
  EXPECT_EQ(fluid.nodes.size(), 19u * 5);  // a station has 19 nodes in the lumen
  EXPECT_NE(fluid.facets("inlet"), nullptr);
  EXPECT_EQ(fluid.facets("outer"), nullptr);
  const auto wall = read_gmsh(folder_ / "tube.msh", {"adventitia", "media"});
  EXPECT_EQ(wall.regions, (std::vector<std::string>{"adventitia", "media"}));
  EXPECT_EQ(wall.nodes.size(), 36u * 5);
  EXPECT_EQ(wall.facets("inlet"), nullptr);
}

TEST_F(GmshFiles, ListsItsVolumes) {
  write_gmsh(test::short_artery(), folder_ / "tube.msh", {"2.2", true});
  EXPECT_EQ(gmsh_regions(folder_ / "tube.msh", 3), (std::vector<std::string>{"fluid", "media", "adventitia"}));
}

TEST_F(GmshFiles, WritesNothingWhereItCannot) {
  const auto mesh = test::short_artery();
  EXPECT_THROW(write_gmsh(mesh, folder_ / "none" / "tube.msh", {}), InputError);
  EXPECT_THROW(write_gmsh(mesh, folder_, {}), InputError);
  EXPECT_THROW(write_gmsh(mesh, folder_ / "tube.msh", {"3.0", false}), InputError);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

}  // namespace
}  // namespace fsi
