// Products of sparse matrices of dense blocks, beside dense ones.
#include <gtest/gtest.h>

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

/// Blocks of a row in one half or the other, found again, and together the row.
TEST(SplitBlocks, HoldWhatTheWholeHolds) {
  const std::vector<std::vector<int>> rows{{0}, {0, 1, 3}, {2}, {0, 2, 3, 4}, {1, 4}};
  SplitBlocks<3> a(rows);
  ASSERT_EQ(a.rows(), 5);
  std::vector<float> x(5 * padded<3>, 0.0f);
  for (int node = 0; node < 5; ++node)
    for (int k = 0; k < 3; ++k) x[node * padded<3> + k] = static_cast<float>(node * 3 + k - 4);
  const auto number = [](int row, int column, int i, int k) {
    return static_cast<float>(7 * row + 5 * column + i - k);
  };
  for (int row = 0; row < 5; ++row)
    for (const int column : rows[row])
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) a.block(a.position(row, column))[k * padded<3> + i] = number(row, column, i, k);
  EXPECT_EQ(a.lower.columns, (std::vector<int>{0, 0, 1, 2, 0, 2, 3, 1, 4}));
  EXPECT_EQ(a.upper.columns, (std::vector<int>{3, 4}));
  for (int row = 0; row < 5; ++row) {
    std::vector<int> columns;
    a.for_row(row, [&](int column, int position) {
      columns.push_back(column);
      EXPECT_EQ(position, a.position(row, column));
    });
    EXPECT_EQ(columns, rows[row]);
    const auto product = a.row_product(row, x.data());
    for (int i = 0; i < 3; ++i) {
      float sum = 0;
      for (const int column : rows[row])
        for (int k = 0; k < 3; ++k) sum += number(row, column, i, k) * x[column * padded<3> + k];
      EXPECT_EQ(product[i], sum) << row;
    }
  }
  a.clear_row(3);
  for (int row = 0; row < 5; ++row)
    a.for_row(row, [&](int, int position) { EXPECT_EQ(a.block(position)[1] == 0, row == 3) << row; });
}

}  // namespace

}  // namespace fsi::test
