#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "algebra/block_products.hpp"
#include "host/threads.hpp"
#include "linear/krylov/gmres.hpp"
#include "linear/krylov/richardson.hpp"
#include "unit/linear/grid_matrices.hpp"

namespace {

using namespace fsi;
using Vector = std::vector<double>;

/// A nonsymmetric, diagonally dominant system with a known solution.
struct Convection {
  BlockMatrix<1, 1> a = test::grid_laplacian(8);
  Vector exact = test::random_vector(512), b = Vector(512);
  LinearOperator apply = [this](const Vector& x, Vector& y) { multiply(a, x, y); };
  LinearOperator jacobi = [](const Vector& x, Vector& y) {
    for (std::size_t i = 0; i < x.size(); ++i) y[i] = x[i] / (6 + 0.01 * static_cast<double>(i % 7));
  };

  Convection() {
    for (int i = 0; i < a.graph->rows(); ++i)
      for (int at = a.graph->offsets[i]; at < a.graph->offsets[i + 1]; ++at)
        if (a.graph->columns[at] > i) a.values[at] = -0.3;
    multiply(a, exact, b);
  }
  double error(const Vector& x) const {
    double largest = 0;
    for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, std::abs(x[i] - exact[i]));
    return largest;
  }
  double true_residual(const Vector& x) const {
    Vector r(b.size());
    residual(a, b, x, r);
    return norm(r) / norm(b);
  }
};

template <class Method>
class BothGmres : public ::testing::Test {};
using Methods = ::testing::Types<Gmres, Fgmres>;
TYPED_TEST_SUITE(BothGmres, Methods);

TYPED_TEST(BothGmres, SolvesANonsymmetricSystem) {
  Convection problem;
  TypeParam method;
  for (const auto& inverse : {LinearOperator(), problem.jacobi}) {
    Vector x;
    const auto report = method.solve(problem.apply, inverse, problem.b, x, {1e-12, 200, 60});
    EXPECT_TRUE(report.converged) << report.failure;
    EXPECT_LT(problem.error(x), 1e-10);
    EXPECT_NEAR(report.relative_residual, problem.true_residual(x), 1e-15);
    EXPECT_EQ(report.history.size(), static_cast<std::size_t>(report.iterations) + 1);
    EXPECT_DOUBLE_EQ(report.history.front(), 1.0);
    for (std::size_t k = 1; k < report.history.size(); ++k)
      EXPECT_LE(report.history[k], report.history[k - 1] * 1.0001);
  }
}

TYPED_TEST(BothGmres, ConvergesOverRestarts) {
  Convection problem;
  TypeParam method;
  Vector x;
  const auto report = method.solve(problem.apply, {}, problem.b, x, {1e-10, 500, 4});
  EXPECT_TRUE(report.converged) << report.failure;
  EXPECT_GT(report.iterations, 8);
  EXPECT_LT(problem.error(x), 1e-8);
}

TYPED_TEST(BothGmres, OneCycleFromZeroBelievesItsEstimate) {
  Convection problem;
  TypeParam method;
  Vector x(3, 7.0);
  const auto report = method.solve_from_zero(problem.apply, problem.jacobi, problem.b, x, 1e-6, 60);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.relative_residual, 1e-6);
  EXPECT_NEAR(report.relative_residual, problem.true_residual(x), 1e-12);
}

TYPED_TEST(BothGmres, ReportsTheIterationLimit) {
  Convection problem;
  TypeParam method;
  Vector x;
  const auto report = method.solve(problem.apply, {}, problem.b, x, {1e-12, 5, 60});
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 5);
  EXPECT_NE(report.failure.find("limit of 5 iterations"), std::string::npos);
  EXPECT_NEAR(report.relative_residual, problem.true_residual(x), 1e-15);
}

TYPED_TEST(BothGmres, ZeroRightHandSideAndExactGuess) {
  Convection problem;
  TypeParam method;
  Vector x = problem.exact;
  auto report = method.solve(problem.apply, {}, Vector(512, 0.0), x, {});
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_EQ(norm(x), 0);
  x = problem.exact;
  report = method.solve(problem.apply, problem.jacobi, problem.b, x, {});
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_EQ(x, problem.exact);
}

/// With A = I + u u^T the Krylov space closes after two steps: a lucky breakdown.
TYPED_TEST(BothGmres, EndsAtALuckyBreakdown) {
  const Vector u = test::random_vector(50), b = test::random_vector(50, 5);
  const LinearOperator a = [&](const Vector& x, Vector& y) {
    const double overlap = dot(u, x);
    for (std::size_t i = 0; i < x.size(); ++i) y[i] = x[i] + overlap * u[i];
  };
  TypeParam method;
  Vector x;
  const auto report = method.solve(a, {}, b, x, {1e-15, 50, 50});
  EXPECT_LE(report.relative_residual, 1e-14);
  Vector image(50);
  a(x, image);
  for (int i = 0; i < 50; ++i) EXPECT_NEAR(image[i], b[i], 1e-13);
}

TYPED_TEST(BothGmres, SaysWhenItCannotSolve) {
  TypeParam method;
  // Singular: the right-hand side has a part outside the range.
  const LinearOperator projector = [](const Vector& x, Vector& y) {
    y = x;
    y[0] = 0;
  };
  Vector x;
  auto report = method.solve(projector, {}, {1.0, 1.0, 1.0}, x, {1e-10, 100, 10});
  EXPECT_FALSE(report.converged);
  EXPECT_FALSE(report.failure.empty());
  EXPECT_NEAR(report.relative_residual, std::sqrt(1.0 / 3), 1e-12);

  const LinearOperator broken = [](const Vector& v, Vector& y) {
    y = v;
    y[1] = std::numeric_limits<double>::quiet_NaN();
  };
  x.assign(3, 0.0);
  report = method.solve(broken, {}, {1.0, 1.0, 1.0}, x, {});
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.failure.find("not finite"), std::string::npos);
}

/// A preconditioner that changes from call to call: the estimate of plain GMRES is then wrong, its report must not be.
TYPED_TEST(BothGmres, IsHonestWithAVaryingPreconditioner) {
  Convection problem;
  int calls = 0;
  const LinearOperator varying = [&](const Vector& x, Vector& y) {
    const double wobble = 0.3 * std::sin(1.7 * ++calls);
    for (std::size_t i = 0; i < x.size(); ++i) y[i] = x[i] * (1 + wobble * std::cos(static_cast<double>(i)));
  };
  TypeParam method;
  Vector x;
  const auto report = method.solve(problem.apply, varying, problem.b, x, {1e-9, 400, 20});
  EXPECT_TRUE(report.converged) << report.failure;
  EXPECT_LE(problem.true_residual(x), 1e-9);
}

TEST(Richardson, ConvergesDivergesAndStopsAtItsLimit) {
  Convection problem;
  Richardson method;
  Vector x;
  auto report = method.solve(problem.apply, problem.jacobi, problem.b, x, {1e-10, 1000, 0});
  EXPECT_TRUE(report.converged) << report.failure;
  EXPECT_LE(problem.true_residual(x), 1e-10);
  const int needed = report.iterations;

  x.assign(512, 0.0);
  report = method.solve(problem.apply, problem.jacobi, problem.b, x, {1e-10, needed - 1, 0});
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.failure.find("limit"), std::string::npos);

  x.assign(512, 0.0);
  const LinearOperator identity = [](const Vector& r, Vector& c) { c = r; };
  report = method.solve(problem.apply, identity, problem.b, x, {1e-10, 1000, 0});
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.failure, "diverged");
}

TEST(VectorOperations, DotDoesNotDependOnThreads) {
  const Vector x = test::random_vector(100003, 1), y = test::random_vector(100003, 2);
  set_threads(1);
  const double serial = dot(x, y);
  long double reference = 0;
  for (std::size_t i = 0; i < x.size(); ++i) reference += static_cast<long double>(x[i]) * y[i];
  set_threads(3);
  EXPECT_EQ(dot(x, y), serial);
  set_threads(0);
  EXPECT_NEAR(serial, static_cast<double>(reference), 1e-11);
}

TEST(BlockProducts, AgreeWithEntryByEntrySums) {
  const auto graph = test::grid_graph(4);
  const auto a = test::random_matrix<4, 3>(graph, 1);
  const Vector x = test::random_vector(64 * 3), b = test::random_vector(64 * 4, 4);
  Vector expected(64 * 4, 0.0);
  for (int i = 0; i < 64; ++i)
    for (int at = graph->offsets[i]; at < graph->offsets[i + 1]; ++at)
      for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 3; ++c) expected[i * 4 + r] += a.block(at)[r * 3 + c] * x[graph->columns[at] * 3 + c];
  Vector y(64 * 4), r(64 * 4), sum = b;
  multiply(a, x, y);
  residual(a, b, x, r);
  multiply_subtract(a, x, sum);
  for (int i = 0; i < 64 * 4; ++i) {
    EXPECT_NEAR(y[i], expected[i], 1e-13);
    EXPECT_NEAR(r[i], b[i] - expected[i], 1e-13);
    EXPECT_NEAR(sum[i], b[i] - expected[i], 1e-13);
  }
  const auto scalar = test::grid_laplacian(4);
  Vector image(64 * 3), component(64), component_image(64);
  multiply_components<3>(scalar, x, image);
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 64; ++i) component[i] = x[i * 3 + k];
    multiply(scalar, component, component_image);
    for (int i = 0; i < 64; ++i) EXPECT_DOUBLE_EQ(image[i * 3 + k], component_image[i]);
  }
}

}  // namespace
