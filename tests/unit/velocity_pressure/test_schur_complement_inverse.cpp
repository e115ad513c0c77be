// Pressures by a factor of the Schur complement, and by a cycle where there is none.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "linear/velocity_pressure/schur_complement_inverse.hpp"

namespace fsi::test {

namespace {

/// -(five-point Laplacian) on an m x m grid, less `mass` on the diagonal; off-diagonal entries are skewed by `skew`.
CsrMatrix<double> schur_of_a_plane(int m, double mass, double skew = 0) {
  CsrMatrix<double> a;
  a.columns = m * m;
  const auto add = [&](int column, double value) {
    a.indices.push_back(column);
    a.values.push_back(value);
  };
  for (int i = 0; i < m * m; ++i) {
    if (i >= m) add(i - m, 1 - skew);
    if (i % m > 0) add(i - 1, 1 - skew);
    add(i, -4 - mass);
    if (i % m < m - 1) add(i + 1, 1 + skew);
    if (i < m * m - m) add(i + m, 1 + skew);
    a.offsets.push_back(static_cast<int>(a.indices.size()));
  }
  return a;
}

/// |S x - r| / |r| of a rough r.
double left_by(SchurComplementInverse& inverse, const CsrMatrix<double>& s) {
  std::vector<float> r(s.rows()), x(s.rows());
  for (int i = 0; i < s.rows(); ++i) r[i] = static_cast<float>((i * 7919 % 101) / 50.0 - 1);
  inverse.apply(r, x);
  std::vector<double> product, in(x.begin(), x.end());
  product.resize(in.size());
  multiply(s, in, product);
  double left = 0, whole = 0;
  for (int i = 0; i < s.rows(); ++i) {
    left += (product[i] - r[i]) * (product[i] - r[i]);
    whole += double(r[i]) * r[i];
  }
  return std::sqrt(left / whole);
}

TEST(SchurComplementInverse, SolvesByItsFactorToTheDigitsOfSinglePrecision) {
  SchurComplementInverse inverse;
  for (const double mass : {0.0, 1.0}) {
    const auto s = schur_of_a_plane(40, mass);
    inverse.set_up(s, {}, true);
    EXPECT_LT(left_by(inverse, s), 1e-4);
    EXPECT_EQ(inverse.levels(), 1);
    EXPECT_EQ(inverse.operator_complexity(), 1);
    EXPECT_GT(inverse.bytes(), sizeof(float) * s.values.size() / 2);
  }
}

TEST(SchurComplementInverse, CyclesWhereNothingElseIsAskedForOrPossible) {
  const auto s = schur_of_a_plane(40, 0), indefinite = schur_of_a_plane(40, -2.1);
  SchurComplementInverse cycle, indefinite_cycle;
  cycle.set_up(s, {}, false);
  const double left = left_by(cycle, s);
  EXPECT_GT(left, 1e-3);
  EXPECT_LT(left, 1);
  EXPECT_GT(cycle.levels(), 1);
  indefinite_cycle.set_up(indefinite, {}, false);
  SchurComplementInverse inverse;  // which has had a factor before
  inverse.set_up(s, {}, true);
  inverse.set_up(indefinite, {}, true);
  EXPECT_GT(inverse.levels(), 1);
  EXPECT_EQ(left_by(inverse, indefinite), left_by(indefinite_cycle, indefinite));
}

TEST(SchurComplementInverse, TakesTheSymmetricPart) {
  const auto skewed = schur_of_a_plane(40, 1, 0.05), symmetric = schur_of_a_plane(40, 1);
  SchurComplementInverse inverse;
  inverse.set_up(skewed, {}, true);
  EXPECT_LT(left_by(inverse, symmetric), 1e-4);
}

}  // namespace

}  // namespace fsi::test
