#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "mesh/mesh_checks.hpp"
#include "mesh/quality.hpp"
#include "mesh/renumber.hpp"
#include "meshes.hpp"

namespace fsi {
namespace {

bool is_permutation_of(std::vector<int> order, std::size_t count) {
  std::sort(order.begin(), order.end());
  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), 0);
  return order == all;
}

/// The mesh with nodes and cells in random order.
TetrahedralMesh shuffled(const TetrahedralMesh& mesh) {
  Renumbering order;
  order.node_new_to_old.resize(mesh.nodes.size());
  order.cell_new_to_old.resize(mesh.cells.size());
  std::iota(order.node_new_to_old.begin(), order.node_new_to_old.end(), 0);
  std::iota(order.cell_new_to_old.begin(), order.cell_new_to_old.end(), 0);
  std::mt19937 random(7);
  std::shuffle(order.node_new_to_old.begin(), order.node_new_to_old.end(), random);
  std::shuffle(order.cell_new_to_old.begin(), order.cell_new_to_old.end(), random);
  return renumbered(mesh, order);
}

TEST(Renumber, IsAPermutationOfNodesAndCells) {
  const auto mesh = shuffled(test::coarse_artery());
  const auto order = reverse_cuthill_mckee(mesh);
  EXPECT_TRUE(is_permutation_of(order.node_new_to_old, mesh.nodes.size()));
  EXPECT_TRUE(is_permutation_of(order.cell_new_to_old, mesh.cells.size()));
}

TEST(Renumber, NarrowsTheBandToAboutOneStation) {
  const auto mesh = shuffled(test::coarse_artery());
  const auto narrow = renumbered(mesh, reverse_cuthill_mckee(mesh));
  EXPECT_GT(bandwidth(mesh), 900);
  EXPECT_LT(bandwidth(narrow), 2 * 43);  // a station has 43 nodes
}

TEST(Renumber, LeavesTheMeshAsItIs) {
  const auto mesh = shuffled(test::coarse_artery());
  const auto other = renumbered(mesh, reverse_cuthill_mckee(mesh));
  const auto before = measure_quality(mesh), after = measure_quality(other);
  for (std::size_t r = 0; r < before.regions.size(); ++r) {
    EXPECT_NEAR(after.regions[r].volume, before.regions[r].volume, 1e-10);
    EXPECT_DOUBLE_EQ(after.regions[r].min_eta, before.regions[r].min_eta);
    EXPECT_EQ(after.regions[r].layers, before.regions[r].layers);
  }
  SceneMeshNeeds needs;
  needs.fluid = needs.inlet = needs.outlet = true;
  needs.layers = {"media", "adventitia"};
  EXPECT_NO_THROW(check_scene_mesh(other, needs, "renumbered"));
}

TEST(Renumber, SortsCellsByTheirSmallestNode) {
  const auto mesh = shuffled(test::short_artery());
  const auto other = renumbered(mesh, reverse_cuthill_mckee(mesh));
  const auto smallest = [](const auto& cell) { return *std::min_element(cell.begin(), cell.end()); };
  for (std::size_t c = 1; c < other.cells.size(); ++c)
    EXPECT_LE(smallest(other.cells[c - 1]), smallest(other.cells[c]));
}

TEST(Renumber, InverseOfAPermutation) {
  EXPECT_EQ(inverse_permutation({2, 0, 3, 1}), (std::vector<int>{1, 3, 0, 2}));
}

TEST(Renumber, HandlesUnconnectedParts) {
  TetrahedralMesh mesh;
  mesh.nodes.resize(8);
  mesh.cells = {{0, 2, 4, 6}, {1, 3, 5, 7}};
  mesh.cell_region = {0, 0};
  mesh.regions = {"fluid"};
  EXPECT_TRUE(is_permutation_of(reverse_cuthill_mckee(mesh).node_new_to_old, 8));
}

// The build says which of the two holds, not NDEBUG itself: a preset that loses or gains it must be noticed.
TEST(Assertions, AreOnInAllBuildsButRelease) {
  const std::vector<int> no_permutation{0, 0}, far_outside{0, 5};
#ifdef FSI_ASSERTIONS_EXPECTED
  EXPECT_DEATH(inverse_permutation(no_permutation), "occurs twice");
  EXPECT_DEATH(inverse_permutation(far_outside), "inverse.size");
  EXPECT_DEATH(static_cast<void>(no_permutation[far_outside.size()]), "Assertion '__n < this->size\\(\\)' failed");
#else
  EXPECT_EQ(inverse_permutation(no_permutation).size(), 2u);
#endif
}

}  // namespace
}  // namespace fsi
