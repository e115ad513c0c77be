// Products of sparse matrices of dense blocks, beside dense ones.
#include <gtest/gtest.h>

#include "algebra/block_products.hpp"
#include "algebra/register_blocks.hpp"

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

}  // namespace

}  // namespace fsi::test
