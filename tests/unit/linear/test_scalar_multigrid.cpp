// Smoothed aggregation as the solver of Laplacians: contraction, independence of size and of the number of threads.
#include <gtest/gtest.h>

#include <cmath>

#include "csr_laplacian.hpp"
#include "host/threads.hpp"
#include "linear/amg/scalar_multigrid.hpp"

namespace fsi::test {

namespace {

double norm_of(const std::vector<float>& x) {
  double sum = 0;
  for (float v : x) sum += double(v) * v;
  return std::sqrt(sum);
}

/// Mean contraction of the residual over ten cycles, as a stand-alone iteration.
double contraction(const CsrMatrix<double>& matrix, ScalarMultigrid& multigrid, bool both_sweeps) {
  ScalarMultigrid::Options options;
  options.post_smoothing = both_sweeps;
  multigrid.set_up(matrix, options);
  const auto a = converted<float>(matrix);
  std::vector<float> b(matrix.rows()), x(b.size(), 0.0f), r(b), e(b);
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = static_cast<float>((i * 37 % 101) - 50.0);
  const double first = norm_of(b);
  int cycles = 0;
  // Single precision: stop well before the rounding floor.
  for (; cycles < 10; ++cycles) {
    residual(a, b, x, r);
    if (norm_of(r) < 1e-5 * first) break;
    multigrid.cycle(r, e);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += e[i];
  }
  residual(a, b, x, r);
  return std::pow(norm_of(r) / first, 1.0 / cycles);
}

TEST(ScalarMultigrid, ContractsIndependentlyOfSize) {
  ScalarMultigrid small, large;
  const double coarse = contraction(csr_laplacian(12), small, true), fine = contraction(csr_laplacian(28), large, true);
  EXPECT_LT(coarse, 0.25);
  EXPECT_LT(fine, 0.3);
  EXPECT_GT(large.levels(), small.levels());
  EXPECT_LT(large.operator_complexity(), 2.5);
  EXPECT_LT(contraction(csr_laplacian(28), large, false), 0.6);
}

TEST(ScalarMultigrid, SmallMatricesAreInverted) {
  ScalarMultigrid multigrid;
  EXPECT_LT(contraction(csr_laplacian(5), multigrid, true), 1e-5);
  EXPECT_EQ(multigrid.levels(), 1);
}

TEST(ScalarMultigrid, MatricesThatHardlyCoupleAreSmoothedOnly) {
  ScalarMultigrid multigrid;
  EXPECT_LT(contraction(csr_laplacian(12, 1e9), multigrid, false), 1e-5);
  CsrMatrix<double> diagonal;
  diagonal.columns = 1000;
  for (int i = 0; i < 1000; ++i) {
    diagonal.indices.push_back(i);
    diagonal.values.push_back(i + 1.0);
    diagonal.offsets.push_back(i + 1);
  }
  EXPECT_LT(contraction(diagonal, multigrid, false), 1e-5);
}

TEST(ScalarMultigrid, SameBitsForAnyNumberOfThreads) {
  const auto a = csr_laplacian(20);
  std::vector<float> b(a.rows()), one(b), two(b);
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = static_cast<float>(i % 17) - 8;
  const int before = threads();
  set_threads(1);
  ScalarMultigrid first;
  first.set_up(a);
  first.cycle(b, one);
  set_threads(2);
  ScalarMultigrid second;
  second.set_up(a);
  second.cycle(b, two);
  set_threads(before);
  EXPECT_EQ(one, two);
}

}  // namespace

}  // namespace fsi::test
