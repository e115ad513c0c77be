#include "partitioned/accelerators/filtered_qr.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "algebra/vector_operations.hpp"
#include "partitioned/accelerators/low_rank_map.hpp"

namespace fsi::test {

namespace {

using Vector = std::vector<double>;

std::vector<const Vector*> pointers(const std::vector<Vector>& columns) {
  std::vector<const Vector*> list;
  for (const auto& column : columns) list.push_back(&column);
  return list;
}

TEST(FilteredQr, SolvesLeastSquares) {
  const std::vector<Vector> v{{1, 1, 1}, {0, 1, 2}};
  const FilteredQr qr(pointers(v), 0);
  // The line through (0, 6), (1, 0), (2, 0): 5 - 3 t.
  const auto c = qr.least_squares({6, 0, 0});
  ASSERT_EQ(c.size(), 2u);
  EXPECT_NEAR(c[0], 5, 1e-14);
  EXPECT_NEAR(c[1], -3, 1e-14);
}

TEST(FilteredQr, DropsWhatAddsNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vector> v{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 0.009, 0}, {nan, 0, 0}, {1, 0.02, 0}, {2, 7, 0}};
  const FilteredQr qr(pointers(v), 0.01);
  EXPECT_EQ(qr.kept(), (std::vector<std::size_t>{1, 5}));
}

TEST(FilteredQr, KeepsNoneOfNone) {
  const FilteredQr qr({}, 0.01);
  EXPECT_TRUE(qr.kept().empty());
  EXPECT_TRUE(qr.least_squares({1, 2}).empty());
  EXPECT_TRUE(qr.pseudo_inverse().empty());
}

TEST(FilteredQr, PseudoInverseIsTheLeastSquaresMap) {
  const std::vector<Vector> v{{1, 2, 0, 1}, {0, 1, 1e-3, 0}, {1, 0, 1, 5}};
  const FilteredQr qr(pointers(v), 1e-9);
  const auto rows = qr.pseudo_inverse();
  const Vector b{0.3, -1, 2, 0.7};
  const auto c = qr.least_squares(b);
  ASSERT_EQ(rows.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(dot(rows[i], b), c[i], 1e-11);
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(dot(rows[i], v[j]), i == j ? 1 : 0, 1e-11);
  }
}

TEST(LowRankMap, MultipliesAndTruncatesByTheLargestSingularValues) {
  LowRankMap map;
  map.add({3, 0, 0}, {1, 0, 0});
  map.add({0, 2, 0}, {0, 1, 0});
  map.add({0, 0, 1e-6}, {0, 0, 1});
  map.add({1, 0, 0}, {1, 0, 0});  // parallel to the first
  EXPECT_EQ(map.times({1, 1, 1}), (Vector{4, 2, 1e-6}));
  map.truncate(10, 1e-4);
  EXPECT_EQ(map.rank(), 2u);
  const auto y = map.times({1, 1, 1});
  EXPECT_NEAR(y[0], 4, 1e-14);
  EXPECT_NEAR(y[1], 2, 1e-14);
  EXPECT_NEAR(y[2], 0, 1e-14);
  map.truncate(1, 0);
  EXPECT_NEAR(map.times({1, 1, 1})[1], 0, 1e-14);
  EXPECT_NEAR(map.times({1, 1, 1})[0], 4, 1e-14);
}

TEST(LowRankMap, OfNothingIsZero) {
  LowRankMap map;
  map.truncate(3, 0);
  EXPECT_EQ(map.times({1, 2}), (Vector{0, 0}));
}

}  // namespace

}  // namespace fsi::test
