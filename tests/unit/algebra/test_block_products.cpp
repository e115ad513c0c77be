// Products of sparse matrices of dense blocks, beside dense ones.
#include <gtest/gtest.h>

#include "algebra/block_products.hpp"

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

}  // namespace

}  // namespace fsi::test
