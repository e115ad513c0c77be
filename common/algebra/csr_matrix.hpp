#pragma once

#include <cstddef>
#include <vector>

#include "algebra/registers.hpp"
#include "host/parallel_for.hpp"

namespace fsi {

/// A sparse matrix by rows, column numbers ascending in each: the form that smoothers and Galerkin products take.
template <class Real>
struct CsrMatrix {
  int columns = 0;
  std::vector<int> offsets{0};  ///< rows + 1
  std::vector<int> indices;
  std::vector<Real> values;

  int rows() const { return static_cast<int>(offsets.size()) - 1; }
  std::size_t nonzeros() const { return indices.size(); }
  std::size_t bytes() const { return indices.size() * (sizeof(int) + sizeof(Real)) + offsets.size() * sizeof(int); }
};

/// The same matrix in another precision.
template <class To, class From>
CsrMatrix<To> converted(const CsrMatrix<From>& a) {
  return {a.columns, a.offsets, a.indices, std::vector<To>(a.values.begin(), a.values.end())};
}

/// A^T.
template <class Real>
CsrMatrix<Real> transposed(const CsrMatrix<Real>& a) {
  CsrMatrix<Real> t;
  t.columns = a.rows();
  t.offsets.assign(static_cast<std::size_t>(a.columns) + 1, 0);
  for (int column : a.indices) ++t.offsets[static_cast<std::size_t>(column) + 1];
  for (int row = 0; row < a.columns; ++row) t.offsets[row + 1] += t.offsets[row];
  t.indices.resize(a.nonzeros());
  t.values.resize(a.nonzeros());
  std::vector<int> next(t.offsets.begin(), t.offsets.end() - 1);
  for (int row = 0; row < a.rows(); ++row)
    for (int at = a.offsets[row]; at < a.offsets[row + 1]; ++at) {
      const int to = next[a.indices[at]]++;
      t.indices[to] = row;
      t.values[to] = a.values[at];
    }
  return t;
}

/// A B [Gustavson1978], rows in parallel; each entry is summed in a fixed order.
CsrMatrix<double> product(const CsrMatrix<double>& a, const CsrMatrix<double>& b);

/// Entries begin ... end - 1, of one row, times x, in an order that does not depend on the machine. Four partial sums:
/// rows are short, so that wider registers lose more by summing their lanes and by the remainder than they gain.
template <class Real>
inline Real row_product(const CsrMatrix<Real>& a, int begin, int end, const Real* x) {
  const Real* values = a.values.data();
  const int* indices = a.indices.data();
  Register<4, Real> sums{};
  int at = begin;
  for (; at + 4 <= end; at += 4)
    sums += load<4>(values + at) *
            Register<4, Real>{x[indices[at]], x[indices[at + 1]], x[indices[at + 2]], x[indices[at + 3]]};
  Real rest = 0;
  for (; at < end; ++at) rest += values[at] * x[indices[at]];
  return rest + sum_of_lanes(sums);
}

/// y = A x, rows in parallel; y is not resized.
template <class Real>
void multiply(const CsrMatrix<Real>& a, const std::vector<Real>& x, std::vector<Real>& y) {
  parallel_for(a.rows(), a.nonzeros() > 50000,
               [&](int row) { y[row] = row_product(a, a.offsets[row], a.offsets[row + 1], x.data()); });
}

/// y += A x
template <class Real>
void multiply_add(const CsrMatrix<Real>& a, const std::vector<Real>& x, std::vector<Real>& y) {
  parallel_for(a.rows(), a.nonzeros() > 50000,
               [&](int row) { y[row] += row_product(a, a.offsets[row], a.offsets[row + 1], x.data()); });
}

/// r = b - A x
template <class Real>
void residual(const CsrMatrix<Real>& a, const std::vector<Real>& b, const std::vector<Real>& x, std::vector<Real>& r) {
  parallel_for(a.rows(), a.nonzeros() > 50000,
               [&](int row) { r[row] = b[row] - row_product(a, a.offsets[row], a.offsets[row + 1], x.data()); });
}

}  // namespace fsi
