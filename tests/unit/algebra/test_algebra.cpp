#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "algebra/block_matrix.hpp"
#include "algebra/node_graph.hpp"
#include "base/error.hpp"
#include "linear/direct/cholesky_solver.hpp"
#include "linear/direct/direct_solver.hpp"
#include "linear/direct/gathered_matrix.hpp"
#include "support/random.hpp"

namespace fsi::test {

namespace {

// Two triangles 0-1-2 and 1-3-2 of a square and node 4 of no cell.
TEST(NodeGraph, CouplesNodesThatShareACellAscendingAndOnce) {
  const auto graph = graph_of_cells(5, {0, 1, 2, 1, 3, 2}, 3);
  EXPECT_EQ(graph.rows(), 5);
  EXPECT_EQ(graph.offsets, (std::vector<int>{0, 3, 7, 11, 14, 14}));
  EXPECT_EQ(graph.columns, (std::vector<int>{0, 1, 2, 0, 1, 2, 3, 0, 1, 2, 3, 1, 2, 3}));
  EXPECT_EQ(graph.blocks(), 14);
}

TEST(NodeGraph, FindsBlocksAndMissesThoseThatAreNot) {
  const auto graph = graph_of_cells(5, {0, 1, 2, 1, 3, 2}, 3);
  for (int row = 0; row < graph.rows(); ++row)
    for (int column = 0; column < graph.rows(); ++column) {
      const int at = graph.find(row, column);
      const bool coupled = row < 4 && column < 4 && !(row + column == 3 && row * column == 0);
      EXPECT_EQ(at >= 0, coupled) << row << " " << column;
      if (at >= 0) {
        EXPECT_EQ(graph.columns[at], column);
        EXPECT_GE(at, graph.offsets[row]);
        EXPECT_LT(at, graph.offsets[row + 1]);
      }
    }
}

TEST(BlockMatrix, BlocksAreRowMajorInTheOrderOfTheGraph) {
  BlockMatrix<2, 3> matrix(std::make_shared<NodeGraph>(graph_of_cells(3, {0, 1, 2}, 3)));
  EXPECT_EQ(matrix.values.size(), 9u * 6u);
  matrix.block(4)[1 * 3 + 2] = 7;
  EXPECT_EQ(matrix.values[4 * 6 + 5], 7);
  matrix.set_zero();
  EXPECT_EQ(matrix.values[4 * 6 + 5], 0);
}

/// The matrix with all its entries.
Eigen::MatrixXd dense(const SparseMatrix& a) {
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(a.size(), a.size());
  for (std::int64_t c = 0; c < a.size(); ++c)
    for (std::int64_t k = a.offsets[c]; k < a.offsets[c + 1]; ++k) full(a.rows[k], c) += a.values[k];
  return full;
}

TEST(GatheredMatrix, AddsUpWeightedNumbersAndFollowsThem) {
  std::vector<double> source{1, 10, 100, 1000};
  GatheredMatrix::Builder builder(3);
  builder.add(2, 0, &source[0], 1);
  builder.add(0, 0, &source[1], 0.5);
  builder.add(2, 0, &source[2], -2);  // a second term of the same entry
  builder.add(1, 2, &source[3], 3);
  GatheredMatrix gathered(std::move(builder));
  gathered.update();
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(3, 3);
  expected(2, 0) = 1 - 200;
  expected(0, 0) = 5;
  expected(1, 2) = 3000;
  EXPECT_EQ(dense(gathered.matrix()), expected);
  // Compressed columns, rows ascending, an empty column in the middle.
  EXPECT_EQ(gathered.matrix().offsets, (std::vector<std::int64_t>{0, 2, 2, 3}));
  EXPECT_EQ(gathered.matrix().rows, (std::vector<std::int64_t>{0, 2, 1}));
  EXPECT_EQ(gathered.matrix().nonzeros(), 3);

  source = {2, 20, 0, -1};
  gathered.update();
  EXPECT_EQ(dense(gathered.matrix())(2, 0), 2);
  EXPECT_EQ(dense(gathered.matrix())(0, 0), 10);
  EXPECT_EQ(dense(gathered.matrix())(1, 2), -3);
}

TEST(GatheredMatrix, RefusesMoreUnknownsThanItsNumbersHold) {
  EXPECT_NO_THROW(static_cast<void>(GatheredMatrix::Builder(GatheredMatrix::Builder::largest_size)));
  EXPECT_THROW(GatheredMatrix::Builder(GatheredMatrix::Builder::largest_size + 1), InputError);
}

TEST(SparseMatrix, ProductAgreesWithTheDenseOne) {
  const SparseMatrix a{{0, 2, 3, 5}, {0, 2, 1, 0, 1}, {1, 2, 3, 4, 5}};
  const auto y = product(a, {1, 10, 100});
  EXPECT_EQ(y, (std::vector<double>{401, 530, 2}));
}

/// A sparse matrix without symmetry, diagonally dominant rows but for a zero block on the diagonal as saddle points
/// have.
SparseMatrix random_saddle_point(int velocities, int pressures, unsigned seed) {
  const int n = velocities + pressures;
  Random random(seed);
  SparseMatrix a;
  a.offsets.push_back(0);
  for (int c = 0; c < n; ++c) {
    for (int r = 0; r < n; ++r) {
      const bool corner = r >= velocities && c >= velocities;
      const double value = random();
      if (r == c && !corner) {
        a.rows.push_back(r);
        a.values.push_back(4 + value);
      } else if (!corner && (r * 7 + c * 3) % 5 == 0) {
        a.rows.push_back(r);
        a.values.push_back(value);
      }
    }
    a.offsets.push_back(static_cast<std::int64_t>(a.rows.size()));
  }
  return a;
}

std::vector<double> random_vector(std::size_t n, unsigned seed) {
  Random random(seed);
  std::vector<double> v(n);
  for (double& x : v) x = random();
  return v;
}

double largest_difference(const SparseMatrix& a, const std::vector<double>& b, const std::vector<double>& x) {
  const Eigen::VectorXd reference =
      dense(a).fullPivLu().solve(Eigen::Map<const Eigen::VectorXd>(b.data(), static_cast<Eigen::Index>(b.size())));
  double found = 0;
  for (std::size_t i = 0; i < x.size(); ++i) found = std::max(found, std::abs(x[i] - reference[i]));
  return found;
}

TEST(DirectSolver, AgreesWithADenseFactorisation) {
  for (const char* ordering : {"amd", "metis", "best"})
    for (const char* strategy : {"auto", "unsymmetric", "symmetric"}) {
      const auto a = random_saddle_point(60, 15, 3);
      ASSERT_GT(dense(a).fullPivLu().rank(), 74);
      const auto b = random_vector(75, 4);
      std::vector<double> x;
      DirectSolver solver({ordering, strategy, 0});
      EXPECT_FALSE(solver.factorised());
      solver.factorise(a);
      EXPECT_TRUE(solver.factorised());
      EXPECT_GE(solver.factor_nonzeros(), a.nonzeros() / 2);
      solver.solve(a, b, x);
      EXPECT_LT(largest_difference(a, b, x), 1e-11) << ordering << " " << strategy;
    }
}

TEST(DirectSolver, FactorisesNewValuesOnTheKeptPattern) {
  auto a = random_saddle_point(60, 15, 3);
  const auto b = random_vector(75, 4);
  std::vector<double> x;
  DirectSolver solver;
  solver.factorise(a);
  const auto fresh = random_saddle_point(60, 15, 5);
  ASSERT_EQ(a.rows, fresh.rows);
  // Old factors serve until the new ones are made.
  solver.solve(fresh, b, x);
  EXPECT_LT(largest_difference(a, b, x), 1e-11);
  solver.factorise(fresh);
  solver.solve(fresh, b, x);
  EXPECT_LT(largest_difference(fresh, b, x), 1e-11);
  solver.discard();
  EXPECT_FALSE(solver.factorised());
  solver.factorise(a);
  solver.solve(a, b, x);
  EXPECT_LT(largest_difference(a, b, x), 1e-11);
}

TEST(DirectSolver, SurvivesBeingMoved) {
  const auto a = random_saddle_point(20, 5, 6);
  const auto b = random_vector(25, 7);
  DirectSolver first;
  first.factorise(a);
  DirectSolver second = std::move(first);
  std::vector<double> x;
  second.solve(a, b, x);
  EXPECT_LT(largest_difference(a, b, x), 1e-11);
}

TEST(DirectSolver, RefusesSingularAndUndefinedMatrices) {
  auto a = random_saddle_point(20, 5, 6);
  const auto regular = a;
  for (std::int64_t k = a.offsets[3]; k < a.offsets[4]; ++k) a.values[k] = 0;  // a column of zeros
  DirectSolver solver;
  EXPECT_THROW(solver.factorise(a), ConvergenceError);
  EXPECT_FALSE(solver.factorised());

  a = regular;
  a.values[a.offsets[3]] = std::numeric_limits<double>::quiet_NaN();
  DirectSolver undefined;
  EXPECT_THROW(undefined.factorise(a), ConvergenceError);

  // The same solver recovers with a regular matrix of the pattern.
  solver.factorise(regular);
  EXPECT_TRUE(solver.factorised());
}

/// What comes of factorising and solving for a right-hand side.
void solve_with(const SparseMatrix& a, const std::vector<double>& b, const DirectSolver::Options& options = {}) {
  DirectSolver solver(options);
  std::vector<double> x;
  solver.factorise(a);
  solver.solve(a, b, x, 1e-3);
}

// Rank deficient without a column of zeros. Elimination leaves a zero or rounding, as the processor rounds: with fused multiply-adds
// it is never a zero. Here columns are multiples of each other up to the rounding of their entries, so that it is none anywhere.
TEST(DirectSolver, RefusesColumnsThatAreMultiplesUpToRounding) {
  const std::vector<double> b{1, 2, 3};
  const SparseMatrix equal{{0, 2, 4, 6}, {0, 1, 0, 1, 0, 2}, {1, 2, 1, 2, 5, 1}};
  EXPECT_THROW(solve_with(equal, b), ConvergenceError);
  for (const double factor : {1.0, 3.0, 1e-9, 1e9}) {
    const double x = factor / 3 * (1 + std::numeric_limits<double>::epsilon()), y = factor * 0.7 / 3;
    const SparseMatrix twins{
        {0, 3, 6, 9}, {0, 1, 2, 0, 1, 2, 0, 1, 2}, {1.0, 0.7, 0.3, x, y, factor * 0.3 / 3, 5, 1, 2}};
    EXPECT_THROW(solve_with(twins, b), ConvergenceError) << factor;
    EXPECT_THROW(solve_with(twins, b, {"metis", "auto", 0, true}), ConvergenceError) << factor;
  }
}

// The last column is a third of another but for rounding. A right-hand side in the range of the matrix hides that from the residual.
TEST(DirectSolver, RefusesASingularMatrixWhoseRightHandSideIsInItsRange) {
  auto a = random_saddle_point(60, 0, 3);
  const std::size_t from = a.offsets[59];
  a.rows.resize(from);
  a.values.resize(from);
  for (auto k = a.offsets[54]; k < a.offsets[55]; ++k) {
    a.rows.push_back(a.rows[k]);
    a.values.push_back(a.values[k] / 3 * (k % 2 == 0 ? 1 : 1 + std::numeric_limits<double>::epsilon()));
  }
  a.offsets[60] = a.nonzeros();
  DirectSolver solver;
  EXPECT_NO_THROW(solver.factorise(a)) << "no pivot is zero";
  EXPECT_THROW(solve_with(a, product(a, random_vector(60, 4))), ConvergenceError);
}

// Units that differ by 30 orders of magnitude make the same ratio of pivots as a singular matrix has.
TEST(DirectSolver, TakesUnknownsOfAnySize) {
  auto a = random_saddle_point(60, 15, 3);
  const auto b = random_vector(75, 4);
  std::vector<double> expected, x;
  DirectSolver plain, scaled;
  plain.factorise(a);
  plain.solve(a, b, expected);
  for (std::int64_t c = 0; c < a.size(); ++c)
    for (auto k = a.offsets[c]; k < a.offsets[c + 1]; ++k) a.values[k] = std::ldexp(a.values[k], c % 2 == 0 ? 50 : -50);
  scaled.factorise(a);
  scaled.solve(a, b, x);
  for (int c = 0; c < 75; ++c) EXPECT_NEAR(std::ldexp(x[c], c % 2 == 0 ? 50 : -50), expected[c], 1e-11);
}

/// The Laplacian of a cube of size^3 nodes with values zero around it, and something on the diagonal.
SparseMatrix laplacian_of_a_cube(int size, double diagonal) {
  SparseMatrix a{{0}, {}, {}};
  const auto inside = [size](int i) { return i >= 0 && i < size; };
  for (int i = 0; i < size * size * size; ++i) {
    const int x = i % size, y = i / size % size, z = i / size / size;
    for (int dz = -1; dz <= 1; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          if (std::abs(dx) + std::abs(dy) + std::abs(dz) > 1) continue;
          if (!inside(x + dx) || !inside(y + dy) || !inside(z + dz)) continue;
          a.rows.push_back(i + dx + size * (dy + size * dz));
          a.values.push_back(dx == 0 && dy == 0 && dz == 0 ? 6 + diagonal : -1);
        }
    a.offsets.push_back(a.nonzeros());
  }
  return a;
}

// 4^3 numbers are factorised entry by entry, 14^3 in dense blocks.
TEST(CholeskySolver, SolvesForSeveralRightHandSides) {
  for (const int size : {4, 14}) {
    const auto a = laplacian_of_a_cube(size, 0.1);
    const auto rows = static_cast<std::size_t>(a.size());
    CholeskySolver solver;
    EXPECT_FALSE(solver.factorised());
    EXPECT_EQ(solver.bytes(), 0);
    solver.factorise(a);
    EXPECT_TRUE(solver.factorised());
    EXPECT_GE(solver.bytes(), 8.0 * static_cast<double>(a.nonzeros()) / 2);
    for (const int count : {1, 3, 2}) {
      const auto b = random_vector(rows * static_cast<std::size_t>(count), 4);
      std::vector<double> x;
      solver.solve(b, count, x);
      ASSERT_EQ(x.size(), b.size());
      for (int k = 0; k < count; ++k) {
        const auto from = static_cast<std::ptrdiff_t>(rows) * k, to = from + static_cast<std::ptrdiff_t>(rows);
        const auto product = fsi::product(a, {x.begin() + from, x.begin() + to});
        for (std::size_t i = 0; i < rows; ++i) EXPECT_NEAR(product[i], b[static_cast<std::size_t>(from) + i], 1e-12);
      }
    }
  }
}

TEST(CholeskySolver, TakesNewMatricesAndIsMoved) {
  CholeskySolver first;
  first.factorise(laplacian_of_a_cube(5, 0.1));
  const auto a = laplacian_of_a_cube(3, 2);
  first.factorise(a);
  const auto b = random_vector(27, 4);
  std::vector<double> x;
  CholeskySolver second = std::move(first);
  second.solve(b, 1, x);
  EXPECT_LT(largest_difference(a, b, x), 1e-13);
}

/// A known ordering changes no bit, and one of another pattern with as many entries solves all the same.
TEST(CholeskySolver, TakesOverTheOrderingOfTheMatrixBefore) {
  const auto a = laplacian_of_a_cube(14, 0.1);
  const auto b = random_vector(static_cast<std::size_t>(a.size()), 4);
  CholeskySolver solver, anew;
  solver.factorise(laplacian_of_a_cube(14, 3));
  solver.factorise(a);
  anew.factorise(a);
  EXPECT_EQ(solver.bytes(), anew.bytes());
  std::vector<double> x, expected;
  solver.solve(b, 1, x);
  anew.solve(b, 1, expected);
  EXPECT_EQ(x, expected);
  SparseMatrix other = a;  // rows and columns in another order
  std::vector<std::int64_t> place(static_cast<std::size_t>(a.size()));
  for (std::size_t i = 0; i < place.size(); ++i) place[i] = static_cast<std::int64_t>(i * 1003 % place.size());
  std::vector<std::vector<std::pair<std::int64_t, double>>> columns(place.size());
  for (std::int64_t column = 0; column < a.size(); ++column)
    for (auto at = a.offsets[column]; at < a.offsets[column + 1]; ++at)
      columns[place[column]].emplace_back(place[a.rows[at]], a.values[at]);
  other.rows.clear();
  other.values.clear();
  for (std::size_t column = 0; column < columns.size(); ++column) {
    std::sort(columns[column].begin(), columns[column].end());
    for (const auto& [row, value] : columns[column]) {
      other.rows.push_back(row);
      other.values.push_back(value);
    }
    other.offsets[column + 1] = static_cast<std::int64_t>(other.rows.size());
  }
  solver.factorise(other);
  solver.solve(b, 1, x);
  const auto found = product(other, x);
  for (std::size_t i = 0; i < b.size(); ++i) EXPECT_NEAR(found[i], b[i], 1e-12);
}

/// Of a cube of 18^3 unknowns, which has supernodes wider than a panel.
TEST(CholeskySolver, InSinglePrecisionSolvesToSixDigitsInHalfTheMemory) {
  const auto a = laplacian_of_a_cube(18, 0.1);
  const auto rows = static_cast<std::size_t>(a.size());
  CholeskySolver solver, exact;
  solver.factorise(a);
  exact.factorise(a);
  EXPECT_EQ(solver.residual(), 0);
  solver.reduce_precision(a);
  EXPECT_GT(solver.residual(), 1e-9);
  EXPECT_LT(solver.residual(), 3e-6);
  EXPECT_LT(solver.bytes(), 0.6 * exact.bytes());
  for (const int count : {1, 3, 2}) {
    auto b = random_vector(rows * static_cast<std::size_t>(count), 4);
    for (std::size_t i = 0; i < rows; ++i) b[i] *= 1e40;  // beyond the range of single precision
    std::vector<double> x, reference;
    solver.solve(b, count, x);
    exact.solve(b, count, reference);
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      double error = 0, whole = 0;
      for (std::size_t i = k * rows; i < (k + 1) * rows; ++i) {
        error += (x[i] - reference[i]) * (x[i] - reference[i]) / (k == 0 ? 1e80 : 1);
        whole += reference[i] * reference[i] / (k == 0 ? 1e80 : 1);
      }
      EXPECT_LT(std::sqrt(error / whole), 1e-5) << count << ' ' << k;
      EXPECT_GT(std::sqrt(error / whole), 1e-9) << count << ' ' << k;  // or it would not be what is tested here
    }
  }
  solver.factorise(a);
  EXPECT_EQ(solver.residual(), 0);
}

/// A matrix next to singular, to whose solution the digits that are rounded off matter.
TEST(CholeskySolver, StaysInDoublePrecisionWhereSingleDoesNotServe) {
  auto a = laplacian_of_a_cube(14, 0);
  for (std::int64_t column = 0; column < a.size(); ++column) {  // rows sum up to 1e-9: a constant is next to its kernel
    double sum = 0;
    std::int64_t diagonal = -1;
    for (auto k = a.offsets[column]; k < a.offsets[column + 1]; ++k) {
      if (a.rows[k] == column)
        diagonal = k;
      else
        sum += a.values[k];
    }
    a.values[diagonal] = 1e-9 - sum;
  }
  CholeskySolver solver;
  solver.factorise(a);
  const double bytes = solver.bytes();
  solver.reduce_precision(a);
  EXPECT_EQ(solver.bytes(), bytes);
  EXPECT_EQ(solver.residual(), 0);
}

TEST(CholeskySolver, RefusesWhatIsNotPositiveDefinite) {
  for (const int size : {4, 14}) {
    CholeskySolver solver;
    EXPECT_THROW(solver.factorise(laplacian_of_a_cube(size, -6)), ConvergenceError);
    EXPECT_FALSE(solver.factorised());
    auto undefined = laplacian_of_a_cube(size, 1);
    undefined.values[0] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(solver.factorise(undefined), ConvergenceError);
    solver.factorise(laplacian_of_a_cube(size, 1));
    EXPECT_TRUE(solver.factorised());
  }
}

}  // namespace

}  // namespace fsi::test
