#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algebra/panel_matrix.hpp"
#include "algebra/sparse_matrix.hpp"

namespace fsi {

/// Factors L U = P R A Q of a sparse matrix A in single precision, R being diagonal, P and Q permutations. The factors take
/// less than half of the memory of double ones; a copy of A stands beside them. A solve takes half the time where factors are
/// larger than caches. It is off by about 1e-6 times what a perturbation of A does to the solution: what is left of the
/// right-hand side is looked at, and corrected where more is demanded.
class SingleFactors {
 public:
  SingleFactors() = default;
  /// \param a             A
  /// \param row_order     row of A that is row i of the factors
  /// \param column_order  column of A that is column i of the factors
  /// \param row_scale     R, of rows of A
  SingleFactors(const SparseMatrix& a, const std::vector<std::int64_t>& row_order,
                const std::vector<std::int64_t>& column_order, const std::vector<double>& row_scale);
  /// L, of unit diagonal, by rows.
  void set_lower(const SparseMatrix& rows);
  /// U by columns.
  void set_upper(const SparseMatrix& columns);

  bool empty() const { return y_.empty(); }
  /// x = A^-1 b with |b - A x| <= tolerance |b|, or to rounding.
  void solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) const;
  /// Whether digits enough are right of a solution that is known, for solves to gain by this.
  bool serve() const;
  std::size_t bytes() const;

 private:
  void solve_once(const std::vector<double>& b, std::vector<double>& x) const;
  void compute_residual(const std::vector<double>& b, const std::vector<double>& x,
                        std::vector<double>& residual) const;

  CompactColumns<double> rows_;  ///< of A: its transpose by columns
  PanelMatrix lower_, upper_;    ///< U = D upper_^T
  std::vector<float> diagonal_;  ///< D^-1
  std::vector<int> row_order_, column_order_;
  std::vector<double> row_scale_;  ///< in the order of the factors
  mutable std::vector<float> y_;
  mutable std::vector<double> residual_, correction_;
};

}  // namespace fsi
