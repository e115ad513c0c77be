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
  EXPECT_TRUE(changed([&](auto& m) { rename(m, "inlet", "lca"); }));
}

/// A case may name any surface as an opening or a support.
TEST(MeshHash, KnowsSurfacesOfAnyName) {
  auto mesh = short_artery();
  const auto without = hash_of_mesh(mesh);
  for (auto& group : mesh.facet_groups) {
    if (group.name == "inlet") group.name = "lca";
    if (group.name == "outlet") group.name = "rca";
  }
  const auto hash = hash_of_mesh(mesh);
  EXPECT_NE(hash, without);
  auto exchanged = mesh;
  for (auto& group : exchanged.facet_groups)
    if (group.name == "lca" || group.name == "rca") group.name = group.name == "lca" ? "rca" : "lca";
  EXPECT_NE(hash_of_mesh(exchanged), hash);
  auto smaller = mesh;
  for (auto& group : smaller.facet_groups)
    if (group.name == "lca") group.facets.pop_back();
  EXPECT_NE(hash_of_mesh(smaller), hash);
}

TEST(MeshHash, DoesNotKnowWhatScenesIgnore) {
  const auto mesh = short_artery();
  auto other = mesh;
  std::reverse(other.facet_groups.begin(), other.facet_groups.end());
  for (auto& group : other.facet_groups) std::reverse(group.facets.begin(), group.facets.end());
  other.facet_groups.push_back({"probe", {}});
  std::reverse(other.regions.begin(), other.regions.end());
  for (int& region : other.cell_region) region = static_cast<int>(other.regions.size()) - 1 - region;
  EXPECT_EQ(hash_of_mesh(other), hash_of_mesh(mesh));
}

}  // namespace

}  // namespace fsi::test
