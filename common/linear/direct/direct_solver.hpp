#pragma once

#include <memory>
#include <string>
#include <vector>

#include "algebra/sparse_matrix.hpp"
#include "linear/direct/dense_threads.hpp"

namespace fsi {

/// Sparse LU factorisation (UMFPACK, 64-bit indices). The symbolic analysis is made at the first factorisation and
/// kept: the pattern must not change.
class DirectSolver {
 public:
  /// Fill-reducing ordering and pivoting strategy, by name; the defaults are what measurement favoured
  /// (docs/archive.md).
  struct Options {
    std::string ordering = "metis";  ///< "amd", "metis", "best"
    std::string strategy = "auto";   ///< "auto", "unsymmetric", "symmetric"
    int refinement_steps = 0;        ///< of each solve
    /// Keeps the factors in single precision where that solves this matrix well enough, for solves of a few digits.
    bool single_precision = false;
  };

  DirectSolver();
  explicit DirectSolver(const Options& options);
  ~DirectSolver();
  DirectSolver(DirectSolver&&) noexcept;
  DirectSolver& operator=(DirectSolver&&) noexcept;

  /// \throws ConvergenceError where a pivot is zero or no number, OutOfMemory before what will not fit
  void factorise(const SparseMatrix& a);
  bool factorised() const;
  void discard();

  /// x = A^-1 b with the last factorised matrix A. `a` is read only for iterative refinement and must have A's pattern.
  /// \param tolerance  demanded |b - A x| / |b|; factors in double precision solve to rounding
  /// \throws ConvergenceError where rounding alone decides a thousandth of x: the matrix is singular to working precision. Which
  /// pivot of a singular matrix is zero, and which is rounding, depends on the processor.
  void solve(const SparseMatrix& a, const std::vector<double>& b, std::vector<double>& x, double tolerance = 0) const;

  /// Entries of both factors, for reports.
  long long factor_nonzeros() const;
  /// Whether they are kept in single precision.
  bool in_single_precision() const;
  /// Of the factors.
  double bytes() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace fsi
