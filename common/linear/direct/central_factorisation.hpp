#pragma once

#include <cstdint>
#include <vector>

#include "linear/direct/direct_solver.hpp"
#include "linear/direct/gathered_matrix.hpp"
#include "parallel/communicator.hpp"

namespace fsi {

/// Sparse LU of a matrix whose rows are shared out among processes, for systems so small that sharing the work out costs
/// more than it saves: the first process has all of it, factorises and solves as one process does; the others wait.
/// Unlike a factorisation by all (MUMPS adds in the order in which messages come) it gives the same bits each time. To
/// be called by all processes together.
class CentralFactorisation {
 public:
  CentralFactorisation() = default;
  /// \param terms  of this process's rows; rows and columns are counted among all processes' ones, rows of a process
  ///               before those of the next
  CentralFactorisation(const Communicator& processes, GatheredMatrix::Builder&& terms);

  /// Takes the numbers as they are now, and factorises.
  /// \throws ConvergenceError at all processes when the matrix is singular to working precision or holds NaN
  /// \throws OutOfMemory at the first process alone, when the factors do not fit there
  void update();
  bool factorised() const { return factorised_; }

  /// \param b  per row of this process
  /// \param x  returns all unknowns, at every process
  /// \throws ConvergenceError at all processes, as DirectSolver::solve()
  void solve(const std::vector<double>& b, std::vector<double>& x) const;

  /// Of this process.
  double memory_mib() const;

 private:
  void merge_patterns();

  const Communicator* processes_ = nullptr;
  GatheredMatrix mine_;
  SparseMatrix whole_;               ///< at the first process
  std::vector<std::int64_t> place_;  ///< in it, of each entry of all processes in turn
  DirectSolver solver_;
  bool factorised_ = false;
};

}  // namespace fsi
