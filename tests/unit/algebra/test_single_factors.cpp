#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "algebra/panel_matrix.hpp"
#include "linear/direct/direct_solver.hpp"
#include "support/random.hpp"

namespace fsi::test {

namespace {

double norm(const std::vector<double>& x) {
  double sum = 0;
  for (const double value : x) sum += value * value;
  return std::sqrt(sum);
}

/// |b - A x| / |b|
double lack(const SparseMatrix& a, const std::vector<double>& b, const std::vector<double>& x) {
  std::vector<double> r = product(a, x);
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = b[i] - r[i];
  return norm(r) / norm(b);
}

/// Convection and diffusion on a square grid of side x side nodes, diagonal shifted, rows times `row_scale` by turns.
SparseMatrix grid(int side, double shift, double row_scale = 1) {
  SparseMatrix a;
  a.offsets.push_back(0);
  const auto scale = [&](int row) { return row % 2 == 0 ? 1 : row_scale; };
  for (int column = 0; column < side * side; ++column) {
    const int i = column / side, j = column % side;
    const auto add = [&](int k, int l, double value) {
      if (k < 0 || l < 0 || k >= side || l >= side) return;
      const int row = k * side + l;
      a.rows.push_back(row);
      a.values.push_back(value * scale(row));
    };
    add(i - 1, j, -1.3);
    add(i, j - 1, -0.6);
    add(i, j, 4 + shift);
    add(i, j + 1, -1.4);
    add(i + 1, j, -0.7);
    a.offsets.push_back(static_cast<std::int64_t>(a.rows.size()));
  }
  return a;
}

DirectSolver::Options single() {
  DirectSolver::Options options;
  options.single_precision = true;
  return options;
}

TEST(PanelMatrix, SolvesLikeItsColumnsWhateverItsPanels) {
  // Columns 0 and 1 share their rows, 2 and 3 all but one; 4 has none, 5 to 8 are dense below.
  constexpr int size = 12;
  const std::vector<std::vector<int>> below{{1, 5, 9},
                                            {5, 9},
                                            {3, 6, 7, 8, 10},
                                            {6, 7, 8, 10, 11},
                                            {},
                                            {6, 7, 8, 9, 10, 11},
                                            {7, 8, 9, 10, 11},
                                            {8, 9, 10, 11},
                                            {9, 10, 11},
                                            {},
                                            {11},
                                            {}};
  Random random(7);
  CompactColumns<float> columns;
  columns.offsets.push_back(0);
  for (int j = 0; j < size; ++j) {
    for (const int row : {j - 3, j})  // left out, the diagonal is one
      if (row >= 0) {
        columns.rows.push_back(row);
        columns.values.push_back(17);
      }
    for (const int row : below[j]) {
      columns.rows.push_back(row);
      columns.values.push_back(static_cast<float>(random()));
    }
    columns.offsets.push_back(static_cast<std::int64_t>(columns.rows.size()));
  }
  const PanelMatrix matrix(columns);
  std::vector<float> b(size);
  for (float& value : b) value = static_cast<float>(random());
  std::vector<double> forward(b.begin(), b.end()), backward(b.begin(), b.end());
  for (int j = 0; j < size; ++j)
    for (auto k = columns.offsets[j]; k < columns.offsets[j + 1]; ++k)
      if (columns.rows[k] > j) forward[columns.rows[k]] -= columns.values[k] * forward[j];
  for (int j = size - 1; j >= 0; --j)
    for (auto k = columns.offsets[j]; k < columns.offsets[j + 1]; ++k)
      if (columns.rows[k] > j) backward[j] -= columns.values[k] * backward[columns.rows[k]];
  std::vector<float> x = b;
  matrix.solve(x.data());
  for (int i = 0; i < size; ++i) EXPECT_NEAR(x[i], forward[i], 1e-5) << i;
  x = b;
  matrix.solve_transposed(x.data());
  for (int i = 0; i < size; ++i) EXPECT_NEAR(x[i], backward[i], 1e-5) << i;
}

TEST(SingleFactors, SolveToSixDigitsAndRefineToThoseThatAreDemanded) {
  const SparseMatrix a = grid(60, 0.1, 1e6);
  DirectSolver solver(single()), exact;
  solver.factorise(a);
  exact.factorise(a);
  ASSERT_TRUE(solver.in_single_precision());
  EXPECT_FALSE(exact.in_single_precision());
  EXPECT_EQ(solver.factor_nonzeros(), exact.factor_nonzeros());
  EXPECT_LT(solver.bytes(), 0.7 * exact.bytes());
  Random random(3);
  std::vector<double> x(static_cast<std::size_t>(a.size())), reference;
  for (double& value : x) value = 1e40 * random();  // beyond the range of single precision
  const std::vector<double> b = product(a, x);
  exact.solve(a, b, reference);
  solver.solve(a, b, x, 0.01);
  const double loose = lack(a, b, x);
  EXPECT_LT(loose, 0.01);
  EXPECT_GT(loose, 1e-9);  // or it would not be what is tested here
  for (const double demanded : {1e-6, 1e-10, 1e-13}) {
    solver.solve(a, b, x, demanded);
    EXPECT_LE(lack(a, b, x), demanded);
  }
  solver.solve(a, b, x);  // to rounding
  for (std::size_t i = 0; i < x.size(); ++i) x[i] -= reference[i];
  EXPECT_LT(norm(x), 1e-10 * norm(reference));
}

TEST(SingleFactors, AreNotKeptOfAMatrixThatTheyDoNotSolve) {
  // Solutions of a matrix whose columns sum up to next to nothing answer to changes of its last digits.
  const SparseMatrix easy = grid(40, 1);
  SparseMatrix near = grid(30, 0);
  for (std::int64_t column = 0; column < near.size(); ++column) {  // of Neumann's kind: columns sum up to 1e-9
    double sum = 0;
    std::int64_t diagonal = -1;
    for (auto k = near.offsets[column]; k < near.offsets[column + 1]; ++k) {
      sum += near.values[k];
      if (near.rows[k] == column) diagonal = k;
    }
    near.values[diagonal] += 1e-9 - sum;
  }
  DirectSolver solver(single());
  solver.factorise(near);
  EXPECT_FALSE(solver.in_single_precision());
  const std::vector<double> ones(static_cast<std::size_t>(near.size()), 1.0), b = product(near, ones);
  std::vector<double> x;
  solver.solve(near, b, x, 0.01);
  EXPECT_LT(lack(near, b, x), 1e-10);
  DirectSolver other(single());
  other.factorise(easy);
  EXPECT_TRUE(other.in_single_precision());
  other.discard();
  EXPECT_FALSE(other.factorised());
}

}  // namespace

}  // namespace fsi::test
