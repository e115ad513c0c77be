// Factors of a matrix whose rows processes share, against known solutions. Run by 2 and 3.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "csr_laplacian.hpp"
#include "linear/direct/shared_cholesky.hpp"
#include "shared_matrix.hpp"

namespace fsi::test {

namespace {

double known(std::int64_t number, int right_side) {
  return std::sin(0.7 * static_cast<double>(number) + right_side);
}

/// Largest error of the solutions of three right-hand sides, over all processes.
double largest_error(const SharedMatrix& shared, const SharedCholesky& solver) {
  const ShareOfNumbers& share = shared.graph.share;
  const auto own = static_cast<std::size_t>(share.own);
  std::vector<double> b, x, product(own), exact(share.items());
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < share.items(); ++i) exact[i] = known(share.number(i), c);
    multiply(shared.matrix, exact, product);
    b.insert(b.end(), product.begin(), product.end());
  }
  solver.solve(b, 3, x);
  double largest = x.size() == 3 * own ? 0 : 1e300;
  for (std::size_t c = 0; c < 3 && largest < 1e300; ++c)
    for (std::size_t i = 0; i < own; ++i)
      largest =
          std::max(largest, std::abs(x[own * c + i] - known(share.number(static_cast<int>(i)), static_cast<int>(c))));
  return everyone().largest(largest);
}

TEST(SharedCholesky, SolvesToRoundingAndAgainWithOtherValues) {
  SharedCholesky solver;
  for (const double mass : {0.1, 3.0}) {
    const SharedMatrix shared(everyone(), csr_laplacian(12, mass));
    const auto size = SharedCholesky::size_of(shared.matrix, shared.graph.share);
    EXPECT_EQ(size.separator, 144 * (everyone().size() - 1));
    EXPECT_GE(size.couplings, 144.0 * (1728 / everyone().size() - 144));
    EXPECT_LE(size.couplings, 2 * 144.0 * (1728 / everyone().size() + 1));
    solver.factorise(shared.matrix, shared.graph.share, false);
    EXPECT_EQ(solver.residual(), 0);
    EXPECT_LT(largest_error(shared, solver), 1e-13);
  }
}

TEST(SharedCholesky, KeepsSinglePrecisionOnDemand) {
  const SharedMatrix shared(everyone(), csr_laplacian(16, 0.1));
  SharedCholesky twice, half;
  twice.factorise(shared.matrix, shared.graph.share, false);
  half.factorise(shared.matrix, shared.graph.share, true);
  EXPECT_GT(half.residual(), 0);
  EXPECT_TRUE(half.reaches(1e-4));
  EXPECT_FALSE(half.reaches(1e-12));
  const double error = largest_error(shared, half);
  EXPECT_GT(error, 1e-9);
  EXPECT_LT(error, 1e-5);
  EXPECT_LT(half.bytes(), 0.8 * twice.bytes());
}

/// A chain of a row for each process, and one of fewer rows than processes: some have nothing but unknowns of the separator,
/// or nothing at all.
TEST(SharedCholesky, ProcessesMayHaveNoInnerUnknowns) {
  for (const int rows : {everyone().size(), everyone().size() - 1}) {
    CsrMatrix<double> chain;
    chain.columns = rows;
    for (int row = 0; row < rows; ++row) {
      for (int column = std::max(0, row - 1); column <= std::min(rows - 1, row + 1); ++column) {
        chain.indices.push_back(column);
        chain.values.push_back(column == row ? 2 : -1);
      }
      chain.offsets.push_back(static_cast<int>(chain.indices.size()));
    }
    const SharedMatrix shared(everyone(), chain);
    SharedCholesky solver;
    solver.factorise(shared.matrix, shared.graph.share, false);
    EXPECT_LT(largest_error(shared, solver), 1e-14);
  }
}

/// What one process finds, all throw.
TEST(SharedCholesky, RefusesAMatrixThatIsNotPositiveDefinite) {
  SharedMatrix shared(everyone(), csr_laplacian(6, 0.1));
  if (everyone().rank() + 1 == everyone().size())
    for (double& value : shared.matrix.values) value = -value;
  SharedCholesky solver;
  EXPECT_THROW(solver.factorise(shared.matrix, shared.graph.share, false), ConvergenceError);
  EXPECT_FALSE(solver.factorised());
}

}  // namespace

}  // namespace fsi::test
