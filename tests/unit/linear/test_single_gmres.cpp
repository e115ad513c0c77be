// GMRES in single precision.
#include <gtest/gtest.h>

#include <cmath>

#include "csr_laplacian.hpp"
#include "linear/krylov/gmres.hpp"

namespace fsi::test {

namespace {

const SingleGmres::Operator identity = [](const std::vector<float>& x, std::vector<float>& y) { y = x; };

TEST(SingleGmres, ReachesTheToleranceItReports) {
  const auto a = converted<float>(csr_laplacian(10));
  std::vector<float> b(a.rows(), 1.0f), x, r(b);
  SingleGmres gmres;
  const auto report =
      gmres.solve_from_zero([&](const auto& in, auto& out) { multiply(a, in, out); }, identity, b, x, 1e-3, 100);
  EXPECT_TRUE(report.converged);
  residual(a, b, x, r);
  double sum = 0;
  for (float v : r) sum += double(v) * v;
  EXPECT_NEAR(std::sqrt(sum / b.size()), report.relative_residual, 1e-5);
  EXPECT_LE(report.relative_residual, 1e-3);
}

TEST(SingleGmres, StopsAtTheLimitWithoutCallingItConvergence) {
  const auto a = converted<float>(csr_laplacian(10));
  std::vector<float> b(a.rows(), 1.0f), x;
  SingleGmres gmres;
  const auto report =
      gmres.solve_from_zero([&](const auto& in, auto& out) { multiply(a, in, out); }, identity, b, x, 1e-4, 3);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 3);
  EXPECT_GT(report.relative_residual, 1e-4);
}

TEST(SingleGmres, ZeroRightHandSideAndExactPreconditioner) {
  std::vector<float> x;
  SingleGmres gmres;
  const auto nothing = gmres.solve_from_zero(identity, identity, std::vector<float>(5, 0.0f), x, 1e-3, 10);
  EXPECT_TRUE(nothing.converged);
  EXPECT_EQ(x, std::vector<float>(5, 0.0f));
  const std::vector<float> b{1, -2, 3, 4, 5};
  const auto once = gmres.solve_from_zero(
      [](const auto& in, auto& out) {
        for (std::size_t i = 0; i < in.size(); ++i) out[i] = 4 * in[i];
      },
      [](const auto& in, auto& out) {
        for (std::size_t i = 0; i < in.size(); ++i) out[i] = in[i] / 4;
      },
      b, x, 1e-4, 10);
  EXPECT_TRUE(once.converged);
  EXPECT_EQ(once.iterations, 1);
  for (std::size_t i = 0; i < b.size(); ++i) EXPECT_NEAR(x[i], b[i] / 4, 1e-6);
}

TEST(SingleGmres, SingularOperatorsEndWithoutNaN) {
  const std::vector<float> b{1, 1};
  std::vector<float> x;
  SingleGmres gmres;
  const auto report = gmres.solve_from_zero(
      [](const auto& in, auto& out) {
        out = {in[0], 0.0f};
      },
      identity, b, x, 1e-4, 10);
  EXPECT_FALSE(report.converged);
  for (float value : x) EXPECT_TRUE(std::isfinite(value));
}

}  // namespace

}  // namespace fsi::test
