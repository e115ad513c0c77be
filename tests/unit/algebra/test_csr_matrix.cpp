// Sparse matrices by rows, against dense ones.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cstdint>

#include "algebra/csr_matrix.hpp"
#include "algebra/entry_count.hpp"
#include "base/error.hpp"
#include "support/random.hpp"

namespace fsi::test {

namespace {

CsrMatrix<double> random_matrix(int rows, int columns, unsigned seed) {
  Random random(seed);
  CsrMatrix<double> a;
  a.columns = columns;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column)
      if (random() > 0.2 && row != 2) {  // row 2 stays empty
        a.indices.push_back(column);
        a.values.push_back(random());
      }
    a.offsets.push_back(static_cast<int>(a.indices.size()));
  }
  return a;
}

Eigen::MatrixXd dense(const CsrMatrix<double>& a) {
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(a.rows(), a.columns);
  for (int row = 0; row < a.rows(); ++row)
    for (int at = a.offsets[row]; at < a.offsets[row + 1]; ++at) d(row, a.indices[at]) += a.values[at];
  return d;
}

TEST(CsrMatrix, ProductsAgreeWithDenseOnes) {
  const auto a = random_matrix(9, 7, 1), b = random_matrix(7, 5, 2);
  const auto c = product(a, b);
  EXPECT_EQ(c.rows(), 9);
  EXPECT_EQ(c.columns, 5);
  EXPECT_LT((dense(c) - dense(a) * dense(b)).cwiseAbs().maxCoeff(), 1e-14);
  for (int row = 0; row < c.rows(); ++row)
    for (int at = c.offsets[row] + 1; at < c.offsets[row + 1]; ++at) EXPECT_LT(c.indices[at - 1], c.indices[at]);
  EXPECT_EQ((dense(transposed(a)) - dense(a).transpose()).cwiseAbs().maxCoeff(), 0);
}

TEST(CsrMatrix, VectorProductsAndResidual) {
  const auto a = random_matrix(6, 6, 3);
  const std::vector<double> x{1, -2, 3, 0.5, 0, 4}, b{1, 1, 1, 1, 1, 1};
  const Eigen::VectorXd expected = dense(a) * Eigen::Map<const Eigen::VectorXd>(x.data(), 6);
  std::vector<double> y(6), r(6), sum = b;
  multiply(a, x, y);
  residual(a, b, x, r);
  multiply_add(a, x, sum);
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(y[i], expected(i), 1e-14);
    EXPECT_NEAR(r[i], 1 - expected(i), 1e-14);
    EXPECT_NEAR(sum[i], 1 + expected(i), 1e-14);
  }
}

TEST(CsrMatrix, ProductsOfStretchesOfRows) {
  const auto a = random_matrix(1, 40, 4);
  std::vector<double> x(40);
  Random random(5);
  for (double& value : x) value = random();
  const int entries = static_cast<int>(a.nonzeros());
  for (int begin = 0; begin <= entries; ++begin)
    for (int end = begin; end <= entries; ++end) {
      double expected = 0;
      for (int at = begin; at < end; ++at) expected += a.values[at] * x[a.indices[at]];
      EXPECT_NEAR(row_product(a, begin, end, x.data()), expected, 1e-14) << begin << " to " << end;
    }
}

}  // namespace

TEST(CountsOfEntries, AreRefusedBeyondThePositionsOfAMatrix) {
  EXPECT_EQ(entry_count(0x7fffffff), 0x7fffffff);
  try {
    entry_count(std::int64_t{1} << 31);
    FAIL() << "no message";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "mesh: a matrix has 2147483648 entries, and a process holds at most 2147483647; "
                 "use more processes, or a coarser mesh");
  }
}

}  // namespace fsi::test
