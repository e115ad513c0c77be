// Frames of nodes: which conditions ask for one, and what is turned into it.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "fem/gather_blocks.hpp"
#include "fem/held_components.hpp"
#include "linear/direct/gathered_matrix.hpp"
#include "support/random.hpp"

namespace fsi::test {

namespace {

constexpr double sine = 0.5 * 1.7320508075688772;  // of 60 degrees

template <int n>
void expect_orthonormal(const NodalAxes<n>& axes) {
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) EXPECT_NEAR(detail::dot<n>(axes[i], axes[j]), i == j, 1e-15);
}

TEST(HeldComponents, ConditionsAlongAxesAskForNoFrame) {
  const auto one = hold<3>({{0, -1, 0}});
  EXPECT_FALSE(one.turned);
  EXPECT_EQ(one.held, (std::array<bool, 3>{false, true, false}));
  const auto two = hold<3>({{0, 0, 1}, {1, 0, 0}, {0, 0, -1}});
  EXPECT_FALSE(two.turned);
  EXPECT_EQ(two.held, (std::array<bool, 3>{true, false, true}));
  EXPECT_EQ(hold<2>({{0, 1}}).held, (std::array<bool, 2>{false, true}));
}

TEST(HeldComponents, OneObliqueDirectionTurnsTheAxisNearestToIt) {
  const Direction<3> normal{-sine, 0.5, 0};
  const auto result = hold<3>({normal});
  ASSERT_TRUE(result.turned);
  EXPECT_EQ(result.held, (std::array<bool, 3>{true, false, false}));
  expect_orthonormal<3>(result.axes);
  EXPECT_NEAR(detail::dot<3>(result.axes[0], normal), -1, 1e-15);
  EXPECT_EQ(result.axes[2], (Direction<3>{0, 0, 1}));  // across the rotation: it stays
  EXPECT_NEAR(result.axes[1][1], sine, 1e-15);         // the smallest rotation, by 30 degrees

  const double c = std::sqrt(1.0 / 3);
  const auto corner = hold<3>({{c, -c, c}});
  expect_orthonormal<3>(corner.axes);
  const auto edge = hold<2>({{0.6, 0.8}});
  ASSERT_TRUE(edge.turned);
  EXPECT_EQ(edge.held, (std::array<bool, 2>{false, true}));
  expect_orthonormal<2>(edge.axes);
}

TEST(HeldComponents, BetweenTwoPlanesTheirLineRemains) {
  const auto along_z = hold<3>({{0, 1, 0}, {-sine, 0.5, 0}});
  EXPECT_FALSE(along_z.turned);
  EXPECT_EQ(along_z.held, (std::array<bool, 3>{true, true, false}));

  const Direction<3> u{0.6, 0.8, 0}, v{0, 0.6, 0.8};
  const auto oblique = hold<3>({u, v});
  ASSERT_TRUE(oblique.turned);
  expect_orthonormal<3>(oblique.axes);
  int free = 0;
  for (int k = 0; k < 3; ++k) {
    if (oblique.held[k]) continue;
    ++free;
    EXPECT_NEAR(detail::dot<3>(oblique.axes[k], u), 0, 1e-15);
    EXPECT_NEAR(detail::dot<3>(oblique.axes[k], v), 0, 1e-15);
  }
  EXPECT_EQ(free, 1);

  const auto all = hold<3>({u, v, {0, 0, 1}});
  EXPECT_FALSE(all.turned);
  EXPECT_EQ(all.held, (std::array<bool, 3>{true, true, true}));
  // One plane in two groups is one plane.
  EXPECT_EQ(hold<3>({u, {0.6 + 1e-9, 0.8, 0}}).held, hold<3>({u}).held);
}

/// Three nodes in a row, all coupled; the second has a frame.
struct Row {
  BlockMatrix<4, 3> matrix;
  NodalFrames<3> frames;
  std::vector<double> x;

  Row() {
    auto graph = std::make_shared<NodeGraph>();
    graph->offsets = {0, 3, 6, 9};
    graph->columns = {0, 1, 2, 0, 1, 2, 0, 1, 2};
    matrix = BlockMatrix<4, 3>(graph);
    Random random(3);
    for (double& value : matrix.values) value = random();
    for (int i = 0; i < 9; ++i) x.push_back(random());
    frames.turn(1, hold<3>({{0.48, 0.6, 0.64}}).axes);
  }
  static std::vector<double> product(const BlockMatrix<4, 3>& a, const std::vector<double>& x) {
    std::vector<double> y(12, 0.0);
    for (int row = 0; row < 3; ++row)
      for (int at = a.graph->offsets[row]; at < a.graph->offsets[row + 1]; ++at)
        for (int i = 0; i < 4; ++i)
          for (int k = 0; k < 3; ++k) y[4 * row + i] += a.block(at)[3 * i + k] * x[3 * a.graph->columns[at] + k];
    return y;
  }
};

TEST(NodalFrames, TurnedMatricesWorkOnTurnedVectors) {
  Row row;
  auto expected = Row::product(row.matrix, row.x);
  row.frames.to_frames<MixedLayout<3>>(expected);
  auto turned = row.matrix;
  row.frames.turn_blocks(turned);
  auto x = row.x;
  row.frames.to_frames<VectorLayout<3>>(x);
  EXPECT_NE(x, row.x);
  const auto y = Row::product(turned, x);
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(y[i], expected[i], 1e-15) << i;
  row.frames.to_space<VectorLayout<3>>(x);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], row.x[i], 1e-15);
  EXPECT_EQ(row.frames.at(0), nullptr);
  EXPECT_EQ(row.frames.at(2), nullptr);
}

TEST(NodalFrames, NumbersPerComponentAreGatheredInTheFrames) {
  Row row;
  BlockMatrix<1, 3> diagonal(row.matrix.graph);
  Random random(5);
  for (double& value : diagonal.values) value = random();
  BlockMatrix<4, 3> full(row.matrix.graph);
  for (int at = 0; at < 9; ++at)
    for (int k = 0; k < 3; ++k) full.block(at)[3 * k + k] = diagonal.block(at)[k];
  row.frames.turn_blocks(full);
  UnknownMap map(9);
  for (int i = 0; i < 9; ++i) map[i] = {i, 1.0};
  GatheredMatrix::Builder builder(9);
  gather_diagonal_blocks(builder, diagonal, map, map, &row.frames);
  GatheredMatrix gathered(std::move(builder));
  gathered.update();
  const SparseMatrix& a = gathered.matrix();
  for (int column = 0; column < 9; ++column)
    for (auto at = a.offsets[column]; at < a.offsets[column + 1]; ++at) {
      const int i = static_cast<int>(a.rows[at]);
      EXPECT_NEAR(a.values[at], full.block(3 * (i / 3) + column / 3)[3 * (i % 3) + column % 3], 1e-15);
    }
}

TEST(VanishingComponents, AreTakenOutOfTheFieldAndNothingElse) {
  VanishingComponents<3> vanishing;
  const auto held = hold<3>({{0.6, 0.8, 0}});
  vanishing.frames.turn(1, held.axes);
  for (int k = 0; k < 3; ++k)
    if (held.held[k]) vanishing.entries.push_back(3 + k);
  vanishing.entries.push_back(6);
  std::vector<double> field{1, 2, 3, 4, 5, 6, 7, 8, 9};
  vanishing.clear(field);
  const double along = 0.6 * 4 + 0.8 * 5;
  const std::vector<double> expected{1, 2, 3, 4 - 0.6 * along, 5 - 0.8 * along, 6, 0, 8, 9};
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(field[i], expected[i], 1e-14);
}

}  // namespace

}  // namespace fsi::test
