// Power iteration: known eigenvalues, the extrapolation of a geometric sequence, and its end when nothing is left.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "linear/krylov/power_iteration.hpp"

namespace fsi::test {

namespace {

TEST(PowerIteration, FindsTheLargestEigenvalueOfADiagonalMatrix) {
  const auto estimate = [](int iterations) {
    return largest_eigenvalue(rough_vector(50), iterations, [](const auto& x, auto& y) {
      for (std::size_t i = 0; i < x.size(); ++i) y[i] = (i == 17 ? -4.0 : 2.0 / (1.0 + static_cast<double>(i))) * x[i];
    });
  };
  EXPECT_NEAR(estimate(60), 4, 1e-12);
  EXPECT_LT(estimate(6), 4);  // from below, the matrix being symmetric
  EXPECT_GT(estimate(6), estimate(4));
}

TEST(PowerIteration, EndsWhenNothingIsLeft) {
  int steps = 0;
  const auto growth = power_iteration(10, [&] { return ++steps < 3 ? 1.0 : 0.0; });
  EXPECT_EQ(growth.size(), 3u);
  EXPECT_EQ(growth.back(), 0);
}

TEST(PowerIteration, LimitOfAGeometricSequence) {
  // 2 - 0.5^k: limit 2, a quarter of which is allowed beyond the last estimate
  EXPECT_DOUBLE_EQ(extrapolated_limit(1, 1.5, 1.75, 0.25), 2);
  EXPECT_DOUBLE_EQ(extrapolated_limit(1, 1.5, 1.75, 0.1), 1.75 * 1.1);
  EXPECT_DOUBLE_EQ(extrapolated_limit(1, 1.5, 2.1, 0.25), 2.1);  // grows faster and faster: no limit in sight
  EXPECT_DOUBLE_EQ(extrapolated_limit(2, 1.5, 1.25, 0.25), 1.25);
}

TEST(PowerIteration, StartsAreRoughAndAlwaysTheSame) {
  RoughSequence first, second;
  const auto x = rough_vector(1000);
  double least = 1, most = -1;
  for (double value : x) {
    EXPECT_EQ(first(), second());
    least = std::min(least, value);
    most = std::max(most, value);
  }
  EXPECT_GE(least, -1);
  EXPECT_LT(most, 1);
  EXPECT_GT(most - least, 1.9);
  EXPECT_EQ(x, rough_vector(1000));
}

}  // namespace

}  // namespace fsi::test
