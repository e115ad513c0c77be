#include "partitioned/accelerators/filtered_qr.hpp"

#include <gtest/gtest.h>

#include <cstdint>
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

/// One column after the other from the front, as passes give them: the same columns stay, and the same c comes out, as of
/// a factorisation from the beginning. Every fifth column is nearly a combination of two others.
TEST(FilteredQr, GrowsFromTheFrontAsIfFactorisedAnew) {
  constexpr std::size_t size = 40, most = 25;
  std::uint64_t seed = 1;
  const auto random = [&seed] {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(seed >> 33) / 4294967296.0 - 0.25;
  };
  const auto any = [&] {
    Vector v(size);
    for (double& x : v) x = random();
    return v;
  };
  std::vector<Vector> columns;
  FilteredQr grown({}, 0.05);
  const Vector b = any();
  for (int k = 1; k <= 60; ++k) {
    Vector v = any();
    if (k % 5 == 0) {
      scale(1e-2, v);
      axpy(1.5, columns[1], v);
      axpy(-0.5, columns[columns.size() / 2], v);
    }
    ASSERT_TRUE(grown.insert_first(v)) << k;
    columns.insert(columns.begin(), std::move(v));
    const FilteredQr anew(pointers(columns), 0.05);
    ASSERT_EQ(grown.kept(), anew.kept()) << k;
    std::vector<Vector> kept;
    for (const std::size_t j : anew.kept()) kept.push_back(columns[j]);
    columns = std::move(kept);
    const auto c = grown.least_squares(b), expected = anew.least_squares(b);
    ASSERT_EQ(c.size(), expected.size());
    for (std::size_t j = 0; j < c.size(); ++j) EXPECT_NEAR(c[j], expected[j], 1e-11) << k;
    if (columns.size() <= most) continue;
    columns.pop_back();
    grown.remove_last();
  }
  EXPECT_GT(columns.size(), 20u);
}

TEST(FilteredQr, LeavesACombinationOfTheOthersToAFactorisationAnew) {
  const std::vector<Vector> v{{1, 0, 1}, {0, 1, 1}};
  FilteredQr qr(pointers(v), 0.01);
  EXPECT_FALSE(qr.insert_first({2, -3, -1}));
  EXPECT_FALSE(qr.insert_first({0, 0, 0}));
  EXPECT_EQ(qr.kept().size(), 2u);
  EXPECT_NEAR(qr.least_squares({1, 2, 3})[1], 2, 1e-14);
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
