// Elimination with complete pivoting: solutions of regular systems, and what singular ones leave open.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "network/complete_pivoting.hpp"

namespace fsi::test {

namespace {

TEST(CompletePivoting, SolvesWhatIsBadlyScaled) {
  const std::vector<double> matrix{1e-9, 2e-9, 0, 3e6, -1e6, 2e3, 0, 5, 1e-3};
  const std::vector<double> x{2, -3, 5e2};
  std::vector<double> right(3, 0.0), answer;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) right[i] += matrix[3 * i + j] * x[j];
  const CompletePivoting factors(matrix, 3);
  EXPECT_FALSE(factors.singular());
  EXPECT_EQ(factors.solve(right, answer), 0);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(answer[i], x[i], 1e-12 * std::abs(x[i]));
}

TEST(CompletePivoting, SaysWhatASingularMatrixLeavesOpen) {
  // x_0 + x_1 = 3 twice, x_2 = 4: one of the first two is open, and which one is the caller's choice.
  const std::vector<double> matrix{1, 1, 0, 2, 2, 0, 0, 0, 1};
  for (const std::size_t open : {std::size_t{0}, std::size_t{1}}) {
    std::vector<bool> last(3, false);
    last[open] = true;
    const CompletePivoting factors(matrix, 3, last);
    EXPECT_TRUE(factors.singular());
    EXPECT_EQ(factors.open_columns(), std::vector<std::size_t>{open});
    std::vector<double> x;
    EXPECT_NEAR(factors.solve({3, 6, 4}, x), 0, 1e-15);
    EXPECT_EQ(x[open], 0);
    EXPECT_NEAR(x[1 - open], 3, 1e-15);
    EXPECT_NEAR(x[2], 4, 1e-15);
    EXPECT_GT(factors.solve({3, 7, 4}, x), 0.1) << "no x gives this";
  }
}

}  // namespace

}  // namespace fsi::test
