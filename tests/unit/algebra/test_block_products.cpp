// Products of sparse matrices of dense blocks, beside dense ones.
#include <gtest/gtest.h>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "algebra/block_products.hpp"
#include "algebra/register_blocks.hpp"
#include "algebra/split_blocks.hpp"

namespace fsi::test {

namespace {

TEST(BlockProduct, EqualsTheDenseProduct) {
  // A: 2 x 3 blocks of 1 x 2, B: 3 x 2 blocks of 2 x 3; the middle block row of B is empty but for column 1.
  auto left = std::make_shared<NodeGraph>(NodeGraph{{0, 2, 4}, {0, 2, 1, 2}});
  auto right = std::make_shared<NodeGraph>(NodeGraph{{0, 1, 2, 4}, {0, 1, 0, 1}});
  BlockMatrix<1, 2> a(left);
  BlockMatrix<2, 3> b(right);
  for (std::size_t i = 0; i < a.values.size(); ++i) a.values[i] = double(i) - 3;
  for (std::size_t i = 0; i < b.values.size(); ++i) b.values[i] = double(i * i % 13);
  const auto dense = [](const auto& m, int rows, int columns, int row, int column) {
    const int at = m.graph->find(row / rows, column / columns);
    return at < 0 ? 0.0 : m.block(at)[row % rows * columns + column % columns];
  };
  const auto c = block_product(a, b, 2);
  const auto t = transposed(c, 2);
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 6; ++column) {
      double sum = 0;
      for (int k = 0; k < 6; ++k) sum += dense(a, 1, 2, row, k) * dense(b, 2, 3, k, column);
      EXPECT_EQ(dense(c, 1, 3, row, column), sum);
      EXPECT_EQ(dense(t, 3, 1, column, row), sum);
    }
  EXPECT_EQ(c.graph->offsets, (std::vector<int>{0, 2, 4}));
}

/// Rows of 0 to 5 blocks, and parts of them.
template <int size>
void check_register_blocks() {
  auto graph = std::make_shared<NodeGraph>();
  graph->offsets.push_back(0);
  for (int row = 0; row < 6; ++row) {
    for (int k = 0; k < row; ++k) graph->columns.push_back(k);
    graph->offsets.push_back(static_cast<int>(graph->columns.size()));
  }
  BlockMatrix<size, size> a(graph);
  for (std::size_t i = 0; i < a.values.size(); ++i) a.values[i] = double(i * i % 23) - 11;  // exact in single precision
  const RegisterBlocks<size, size> single(a);
  std::vector<float> x(6 * padded<size>, 0.0f);
  for (int node = 0; node < 6; ++node)
    for (int k = 0; k < size; ++k) x[node * padded<size> + k] = static_cast<float>(node * size + k - 4);
  for (int row = 0; row < 6; ++row)
    for (int begin = graph->offsets[row]; begin <= graph->offsets[row + 1]; ++begin) {
      const auto product = single.product(begin, graph->offsets[row + 1], x.data());
      for (int i = 0; i < size; ++i) {
        double sum = 0;
        for (int at = begin; at < graph->offsets[row + 1]; ++at)
          for (int k = 0; k < size; ++k) sum += a.block(at)[i * size + k] * x[graph->columns[at] * padded<size> + k];
        EXPECT_EQ(product[i], sum) << row << ' ' << begin;
      }
    }
}

TEST(RegisterBlocks, MultiplyAsTheirBlocksDo) {
  check_register_blocks<2>();
  check_register_blocks<3>();
  check_register_blocks<6>();
}

const std::vector<std::vector<int>> few_rows{{0}, {0, 1, 3}, {2}, {0, 2, 3, 4}, {1, 4}};

/// Of a row of few_rows, in the order of its columns.
template <int n, class Number>
std::vector<float> blocks_of(int row, Number number) {
  std::vector<float> blocks;
  for (const int column : few_rows[row])
    for (int k = 0; k < n; ++k)
      for (int i = 0; i < padded<n>; ++i) blocks.push_back(i < n ? number(row, column, i, k) : 0.0f);
  return blocks;
}

/// Blocks of a row in one half or the other, found again, and together the row: numbers of few digits to the last bit, products
/// with odd and even numbers of blocks, whatever lies behind them.
template <int n>
void expect_whole_rows() {
  SplitBlocks<n> a(few_rows);
  ASSERT_EQ(a.rows(), 5);
  std::vector<float> x(5 * padded<n>, 0.0f);
  for (int node = 0; node < 5; ++node)
    for (int k = 0; k < n; ++k) x[node * padded<n> + k] = static_cast<float>(node * n + k - 4);
  // The largest of each row of a triangle is 32767: the unit is one.
  const auto number = [](int row, int column, int i, int k) {
    const bool largest = k == 0 && (column == 0 || column == 1 || column > row);
    return largest ? 32767.0f : static_cast<float>(7 * row + 5 * column + i - k);
  };
  for (int row = 0; row < 5; ++row) a.set_row(row, blocks_of<n>(row, number).data());
  EXPECT_EQ(a.lower.columns, (std::vector<int>{0, 0, 2, 1}));
  EXPECT_EQ(a.upper.columns, (std::vector<int>{4, 3}));
  for (int row = 0; row < 5; ++row) {
    std::vector<int> columns;
    ASSERT_EQ(a.count(row), static_cast<int>(few_rows[row].size()));
    a.for_row(row, [&](int column, const float* block) {
      EXPECT_EQ(a.place(row, column), static_cast<int>(columns.size()));
      columns.push_back(column);
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) EXPECT_EQ(block[k * padded<n> + i], number(row, column, i, k)) << row;
    });
    EXPECT_EQ(columns, few_rows[row]);
    const auto product = a.row_product(row, x.data());
    for (int i = 0; i < padded<n>; ++i) {
      float sum = 0;
      for (const int column : few_rows[row])
        for (int k = 0; k < n && i < n; ++k) sum += number(row, column, i, k) * x[column * padded<n> + k];
      EXPECT_EQ(product[i], sum) << row;
    }
  }
}
TEST(SplitBlocks, HoldWhatTheWholeHolds) {
  expect_whole_rows<2>();
  expect_whole_rows<3>();
}

/// Each number to half a unit, the sums over a row to the digits of single precision, where all numbers are rounded the same way.
TEST(SplitBlocks, KeepWhatARowAddsUpTo) {
  std::vector<int> columns(201);
  std::iota(columns.begin(), columns.end(), 0);
  std::vector<std::vector<int>> rows(201);
  for (int v = 0; v < 201; ++v) rows[v] = {v};
  rows[0] = rows[90] = rows[200] = columns;
  SplitBlocks<3> a(rows);
  constexpr float unit = 3.0f / 32767;
  std::vector<float> blocks, ones(201 * 4, 0.0f);
  for (int v = 0; v < 201; ++v)
    for (int k = 0; k < 3; ++k) {
      ones[v * 4 + k] = 1;
      for (int i = 0; i < 4; ++i) blocks.push_back(i == 3 ? 0 : v % 100 == 50 ? 3.0f : 1000.3f * unit);
    }
  double exact = 0;
  for (std::size_t i = 0; i < blocks.size(); i += 4) exact += blocks[i];
  for (const int row : {0, 90, 200}) {
    a.set_row(row, blocks.data());
    int at = 0, rounded = 0;
    a.for_row(row, [&](int column, const float* block) {
      for (int i = 0; i < 12 && column != row; ++i) {
        EXPECT_NEAR(block[i], blocks[at * 12 + i], 0.501 * unit) << at;
        rounded += std::abs(block[i] - blocks[at * 12 + i]) > 0.2 * unit;
      }
      ++at;
    });
    EXPECT_GT(rounded, 100);
    EXPECT_NEAR(a.row_product(row, ones.data())[0], exact, 1e-5 * exact);
    // A vector that changes sign from node to node meets errors of the size that rounding_squared() tells.
    EXPECT_NEAR(std::sqrt(a.rounding_squared(row, load<3>(ones.data()))), std::sqrt(200 * 3 * 3 / 6.0) * unit,
                3 * unit);
  }
}

/// Rows of zeros stay zero, and what is no number does not become one.
TEST(SplitBlocks, HideNothing) {
  SplitBlocks<3> a(few_rows);
  const std::vector<float> x(5 * 4, 1.0f);
  const auto nothing = [](int, int, int, int) { return 0.0f; };
  for (int row = 0; row < 5; ++row) a.set_row(row, blocks_of<3>(row, nothing).data());
  for (int row = 0; row < 5; ++row) EXPECT_EQ(a.row_product(row, x.data())[1], 0) << row;
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
    for (const int column : {2, 4}) {
      a.set_row(3, blocks_of<3>(3, [&](int, int of, int i, int k) {
                     return of == column && i == 1 && k == 2 ? bad : 1.0f;
                   }).data());
      EXPECT_TRUE(std::isnan(a.row_product(3, x.data())[1])) << column;
      EXPECT_EQ(a.row_product(1, x.data())[1], 0);
    }
}

}  // namespace

}  // namespace fsi::test
