#include "mesh/mesh_hash.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "meshes.hpp"

namespace fsi::test {

namespace {

TEST(MeshHash, KnowsNodesCellsVolumesAndSurfaces) {
  const auto mesh = short_artery();
  const auto hash = hash_of_mesh(mesh);
  EXPECT_EQ(hash.size(), 16u);
  const auto changed = [&](auto change) {
    auto other = mesh;
    change(other);
    return hash_of_mesh(other) != hash;
  };
  const auto rename = [](auto& mesh_, const std::string& from, const std::string& to) {
    for (auto& region : mesh_.regions)
      if (region == from) region = to;
    for (auto& group : mesh_.facet_groups)
      if (group.name == from) group.name = to;
  };
  EXPECT_FALSE(changed([](auto&) {}));
  EXPECT_TRUE(changed([](auto& m) { m.nodes[7][0] *= 1 + 1e-15; }));
  EXPECT_TRUE(changed([](auto& m) { std::swap(m.nodes[7], m.nodes[8]); }));
  EXPECT_TRUE(changed([](auto& m) { std::swap(m.cells[3], m.cells[4]); }));
  EXPECT_TRUE(changed([](auto& m) { m.cell_region[0] = (m.cell_region[0] + 1) % static_cast<int>(m.regions.size()); }));
  EXPECT_TRUE(changed([&](auto& m) { rename(m, "media", "intima"); }));
  EXPECT_TRUE(changed([&](auto& m) {
    rename(m, "media", "x");
    rename(m, "adventitia", "media");
    rename(m, "x", "adventitia");
  })) << "layers exchanged";
  EXPECT_TRUE(changed([&](auto& m) {
    rename(m, "inlet", "x");
    rename(m, "outlet", "inlet");
    rename(m, "x", "outlet");
  })) << "inlet and outlet exchanged";
  EXPECT_TRUE(changed([](auto& m) { m.facet_groups[0].facets.pop_back(); }));
  EXPECT_TRUE(changed([&](auto& m) { rename(m, "wall_ends", "inner"); }));
}

TEST(MeshHash, DoesNotKnowWhatScenesIgnore) {
  const auto mesh = short_artery();
  auto other = mesh;
  std::reverse(other.facet_groups.begin(), other.facet_groups.end());
  for (auto& group : other.facet_groups) std::reverse(group.facets.begin(), group.facets.end());
  other.facet_groups.push_back({"probe", mesh.facet_groups[0].facets});
  std::reverse(other.regions.begin(), other.regions.end());
  for (int& region : other.cell_region) region = static_cast<int>(other.regions.size()) - 1 - region;
  EXPECT_EQ(hash_of_mesh(other), hash_of_mesh(mesh));
}

}  // namespace

}  // namespace fsi::test
