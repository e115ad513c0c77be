// Products with short dense columns, and triangles of them, against plain loops in double precision.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "algebra/panel_products.hpp"
#include "support/random.hpp"

namespace fsi::test {

namespace {

constexpr float untouched = 17;

std::vector<float> random_numbers(std::size_t count, unsigned seed) {
  Random random(seed);
  std::vector<float> numbers(count);
  for (float& number : numbers) number = static_cast<float>(random());
  return numbers;
}

/// Columns whose numbers between two of them are no numbers: they must not be read.
struct Columns {
  int rows, width, pitch = rows + 3;
  std::vector<float> numbers = random_numbers(static_cast<std::size_t>(pitch) * width, 5);

  Columns(int row_count, int column_count) : rows(row_count), width(column_count) {
    for (int j = 0; j < width; ++j)
      for (int i = rows; i < pitch; ++i) numbers[static_cast<std::size_t>(j) * pitch + i] = std::nanf("");
  }
  double operator()(int i, int j) const { return numbers[static_cast<std::size_t>(j) * pitch + i]; }
};

class PanelProducts : public testing::TestWithParam<int> {
 protected:
  const int width = GetParam();
};

TEST_P(PanelProducts, AgreeWithPlainLoops) {
  for (const int rows : {0, 1, 3, 4, 5, 8, 11, 12, 15, 33, 64}) {
    const Columns columns(rows, width);
    const auto x = random_numbers(width, 1), below = random_numbers(rows, 2);
    auto to = below, y = x;
    to.push_back(untouched);
    y.push_back(untouched);
    subtract_combination(columns.numbers.data(), columns.pitch, rows, width, x.data(), to.data());
    subtract_products(columns.numbers.data(), columns.pitch, rows, width, below.data(), y.data());
    for (int i = 0; i < rows; ++i) {
      double expected = below[i];
      for (int j = 0; j < width; ++j) expected -= columns(i, j) * x[j];
      EXPECT_NEAR(to[i], expected, 1e-5) << rows << " rows, " << i;
    }
    for (int j = 0; j < width; ++j) {
      double expected = x[j];
      for (int i = 0; i < rows; ++i) expected -= columns(i, j) * below[i];
      EXPECT_NEAR(y[j], expected, 1e-5) << rows << " rows, column " << j;
    }
    EXPECT_EQ(to.back(), untouched);
    EXPECT_EQ(y.back(), untouched);
  }
}

TEST_P(PanelProducts, SolveTriangles) {
  auto triangle = random_numbers(static_cast<std::size_t>(width) * width, 3);
  for (float& number : triangle) number *= 0.2F;
  for (int j = 0; j < width; ++j)
    for (int i = 0; i <= j; ++i) triangle[static_cast<std::size_t>(j) * width + i] = std::nanf("");
  const auto right = random_numbers(width, 4);
  std::vector<double> forward(right.begin(), right.end()), backward = forward;
  const auto entry = [&](int i, int j) -> double { return triangle[static_cast<std::size_t>(j) * width + i]; };
  for (int j = 0; j < width; ++j)
    for (int i = j + 1; i < width; ++i) forward[i] -= entry(i, j) * forward[j];
  for (int j = width - 1; j >= 0; --j)
    for (int i = j + 1; i < width; ++i) backward[j] -= entry(i, j) * backward[i];
  auto y = right, z = right;
  y.push_back(untouched);
  z.push_back(untouched);
  solve_unit_lower(triangle.data(), width, y.data());
  solve_unit_lower_transposed(triangle.data(), width, z.data());
  for (int i = 0; i < width; ++i) {
    EXPECT_NEAR(y[i], forward[i], 1e-4 * (1 + std::abs(forward[i]))) << i;
    EXPECT_NEAR(z[i], backward[i], 1e-4 * (1 + std::abs(backward[i]))) << i;
  }
  EXPECT_EQ(y.back(), untouched);
  EXPECT_EQ(z.back(), untouched);
}

INSTANTIATE_TEST_SUITE_P(Widths, PanelProducts, testing::Values(1, 2, 3, 4, 5, 7, 8, 9, 16, 31, 64));

}  // namespace

}  // namespace fsi::test
