// Unknowns that follow two others, taken out of a matrix: the same solution, several right-hand sides, and who is taken.
#include <gtest/gtest.h>

#include <vector>

#include "mesh_motion/follower_elimination.hpp"
#include "support/random.hpp"

namespace fsi::test {

namespace {

/// A closed chain of `leaders` unknowns, each of which couples with the second next too; between neighbours a follower.
/// Leaders have even numbers, followers odd ones.
CsrMatrix<double> chain(int leaders) {
  const int size = 2 * leaders;
  std::vector<std::vector<double>> dense(size, std::vector<double>(size, 0.0));
  const auto couple = [&](int i, int j, double value) {
    dense[i][j] += value;
    dense[j][i] += value;
    dense[i][i] += 1.1 * std::abs(value);
    dense[j][j] += 1.1 * std::abs(value);
  };
  Random random(3);
  for (int i = 0; i < size; i += 2) {
    couple(i, (i + 2) % size, -1 - 0.3 * random());
    couple(i, (i + 4) % size, -0.5);
    couple(i, i + 1, -0.7 - 0.2 * random());
    couple(i + 1, (i + 2) % size, -0.4);
  }
  CsrMatrix<double> a;
  a.columns = size;
  for (const auto& row : dense) {
    for (int j = 0; j < size; ++j)
      if (row[j] != 0) {
        a.indices.push_back(j);
        a.values.push_back(row[j]);
      }
    a.offsets.push_back(static_cast<int>(a.indices.size()));
  }
  return a;
}

TEST(FollowerElimination, TakesOutWhoFollowsTwo) {
  CsrMatrix<double> reduced;
  const FollowerElimination followers(chain(7), reduced);
  EXPECT_EQ(followers.kept(), (std::vector<int>{0, 2, 4, 6, 8, 10, 12}));
  EXPECT_EQ(reduced.rows(), 7);
  EXPECT_EQ(reduced.nonzeros(), 7u * 5) << "nothing fills in where ends are neighbours";
}

TEST(FollowerElimination, WholeAndReducedSystemHaveOneSolution) {
  const auto a = chain(7);
  CsrMatrix<double> reduced;
  const FollowerElimination followers(a, reduced);
  constexpr int count = 2;
  Random random(5);
  std::vector<double> exact, b(count * a.rows());
  for (int i = 0; i < count * a.rows(); ++i) exact.push_back(random());
  for (int c = 0; c < count; ++c)
    for (int row = 0; row < a.rows(); ++row)
      b[c * a.rows() + row] = row_product(a, a.offsets[row], a.offsets[row + 1], exact.data() + c * a.rows());

  std::vector<double> of_kept, x;
  followers.reduce(b, count, of_kept);
  std::vector<double> solution;  // of the reduced system, known
  for (int c = 0; c < count; ++c)
    for (const int row : followers.kept()) solution.push_back(exact[c * a.rows() + row]);
  for (int c = 0; c < count; ++c)
    for (int row = 0; row < reduced.rows(); ++row)
      EXPECT_NEAR(
          of_kept[c * reduced.rows() + row],
          row_product(reduced, reduced.offsets[row], reduced.offsets[row + 1], solution.data() + c * reduced.rows()),
          1e-14);
  followers.complete(b, solution, count, x);
  ASSERT_EQ(x.size(), exact.size());
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], exact[i], 1e-14);
}

/// Of a closed chain where everybody has two neighbours no two neighbours may be taken out.
TEST(FollowerElimination, NoFollowerFollowsAnother) {
  CsrMatrix<double> ring, reduced;
  ring.columns = 6;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j)
      if (const int apart = (i - j + 6) % 6; apart <= 1 || apart == 5) {
        ring.indices.push_back(j);
        ring.values.push_back(i == j ? 3 : -1);
      }
    ring.offsets.push_back(static_cast<int>(ring.indices.size()));
  }
  const FollowerElimination followers(ring, reduced);
  EXPECT_EQ(followers.kept(), (std::vector<int>{1, 3, 5}));
  EXPECT_EQ(reduced.nonzeros(), 9u);
}

}  // namespace

}  // namespace fsi::test
