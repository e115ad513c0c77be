#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algebra/csr_matrix.hpp"
#include "algebra/sparse_matrix.hpp"
#include "linear/direct/cholesky_solver.hpp"
#include "parallel/exchange.hpp"

namespace fsi {

/// Factors of a symmetric positive definite matrix whose rows processes share, by static condensation: with s the unknowns
/// between processes, the separator, and i each process's others, which couple with no other's,
///   S = A_ss - sum A_si W,  S x_s = b_s - sum W^T b_i,  x_i = A_ii^-1 b_i - W x_s,  W = A_ii^-1 A_is.
/// Each process keeps the factor of its A_ii, its W, and its rows of S^-1. One process alone has the factor of all of
/// A. All processes call together. Results do not depend on the number of threads.
class SharedCholesky {
 public:
  SharedCholesky() = default;

  struct Size {
    std::int64_t separator = 0;  ///< unknowns of it, of all processes
    double couplings = 0;        ///< numbers of W, of the process with the most of them
  };
  /// \param a      own rows; columns of copies behind the own ones
  /// \param share  of its columns
  static Size size_of(const CsrMatrix<double>& a, const ShareOfNumbers& share);

  /// A matrix with the same numbers of own unknowns and entries as the one before takes over its ordering.
  /// \param a, share  as for size_of(); the processes of `share` must outlive this
  /// \param single_precision  keep what is the largest in single precision, where that serves (CholeskySolver::reduce_precision)
  /// \throws ConvergenceError when it is not positive definite, OutOfMemory before what will not fit, at all processes
  void factorise(const CsrMatrix<double>& a, const ShareOfNumbers& share, bool single_precision);
  bool factorised() const { return factorised_; }

  /// |b - A x| / |b| that solutions have, as far as known: as CholeskySolver::residual(), the largest of all processes.
  double residual() const { return residual_; }
  bool reaches(double tolerance) const { return tolerance >= 10 * residual_; }

  /// x = A^-1 b for `count` right-hand sides of own unknowns, one behind the other in both.
  void solve(const std::vector<double>& b, int count, std::vector<double>& x) const;

  double bytes() const;

 private:
  /// Per item: it is of the separator.
  static std::vector<char> find_separator(const CsrMatrix<double>& a, const ShareOfNumbers& share);
  /// A_ii
  SparseMatrix inner_rows(const CsrMatrix<double>& a) const;
  void factorise_inner(const SparseMatrix& rows);
  void find_couplings(const CsrMatrix<double>& a);
  void invert_schur_complement(const CsrMatrix<double>& a);

  bool factorised_ = false;
  const Communicator* processes_ = &Communicator::alone();
  double residual_ = 0;
  std::vector<int> inner_;      ///< own unknowns that are not of the separator
  std::vector<int> separated_;  ///< items here that are, own ones first
  int own_separated_ = 0;
  std::vector<std::int64_t> number_;     ///< per separated_, in the separator
  std::vector<int> of_item_;             ///< in inner_ or in separated_
  std::vector<char> is_separated_;       ///< per item
  std::int64_t size_ = 0;                ///< of the separator
  CholeskySolver solver_;                ///< of A_ii
  std::vector<double> couplings_;        ///< W by columns, per separated_ one of inner_.size() rows
  std::vector<float> single_couplings_;  ///< in place of it
  std::vector<double> inverse_;          ///< rows of S^-1 per separated_, of size_ columns
  mutable std::vector<double> inner_b_, inner_x_, of_separator_, separator_x_;
  mutable std::vector<float> single_b_;
};

}  // namespace fsi
