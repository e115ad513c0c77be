#pragma once

#include <memory>
#include <vector>

#include "algebra/sparse_matrix.hpp"

namespace fsi {

/// Sparse Cholesky factorisation of symmetric positive definite matrices ([Chen2008], CHOLMOD, 64-bit indices, METIS
/// ordering). Beside an LU factorisation it keeps one factor, for the most part in dense blocks without indices, and
/// several right-hand sides pass it together: a third of the memory and of the
/// time (docs/archive.md, "Harmonic extension of the mesh motion"). Results do not depend on the number of threads.
class CholeskySolver {
 public:
  CholeskySolver();
  ~CholeskySolver();
  CholeskySolver(CholeskySolver&&) noexcept;
  CholeskySolver& operator=(CholeskySolver&&) noexcept;

  /// A matrix of as many unknowns and entries as the one before takes over its ordering, which is good where it has its
  /// pattern, and valid everywhere.
  /// \param a  symmetric, both halves stored, of which one is read
  /// \throws ConvergenceError when it is not positive definite, OutOfMemory before what will not fit
  void factorise(const SparseMatrix& a);
  bool factorised() const;
  /// Keeps the factor in single precision, in half the memory. Only where a known solution comes out with a residual of at most
  /// 1e-5; else, and where the factor has no supernodes, it stays as it is.
  /// \param a  what was factorised
  void reduce_precision(const SparseMatrix& a);
  /// |b - A x| / |b| that solutions have, as far as known: of the known one. Zero of a factor in double precision.
  double residual() const;
  /// Solutions have a residual of at most `tolerance` |b|, so far as a known one tells; others may have several times as much.
  bool reaches(double tolerance) const { return tolerance >= 10 * residual(); }
  /// Limit for callers that refine a solution where reaches() is false.
  static constexpr int most_corrections = 20;

  /// x = A^-1 b for `count` right-hand sides, one behind the other.
  void solve(const std::vector<double>& b, int count, std::vector<double>& x) const;

  /// Of the factor.
  double bytes() const;

 private:
  struct Implementation;
  void solve_in_double(const std::vector<double>& b, int count, std::vector<double>& x) const;

  std::unique_ptr<Implementation> implementation_;
};

}  // namespace fsi
