#pragma once

#include <cassert>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "algebra/csr_matrix.hpp"
#include "base/error.hpp"
#include "host/available_memory.hpp"
#include "linear/amg/scalar_multigrid.hpp"
#include "linear/amg/shared_rows.hpp"
#include "linear/direct/cholesky_solver.hpp"

namespace fsi {

/// Approximate inverse of the Schur complement S, whose negative is like a Laplacian: one cycle of smoothed aggregation, or
/// a Cholesky factor of the symmetric part of -S in single precision. In the plane factors hardly fill in, and take half
/// of a cycle's time (docs/guide/solvers.md). Of several processes each factorises the whole.
class SchurComplementInverse {
 public:
  /// Takes present values. By all processes together.
  /// \param share      of rows and columns
  /// \param factorise  try a Cholesky factor; multigrid serves where -S is not positive definite or the factor does not
  ///                   fit
  void set_up(const CsrMatrix<double>& s, const ShareOfNumbers& share, const ScalarMultigrid::Options& options,
              bool factorise) {
    processes_ = share.processes;
    factorised_ = factorise && this->factorise(s, share);
    if (!factorised_) multigrid_.set_up(s, share, options);
  }

  void set_up(const CsrMatrix<double>& s, const ScalarMultigrid::Options& options, bool factorise) {
    set_up(s, ShareOfNumbers(Communicator::alone(), s.rows(), {}), options, factorise);
  }

  /// p = S^-1 r, both of own rows.
  void apply(const std::vector<float>& r, std::vector<float>& p) {
    if (!factorised_) return multigrid_.cycle(r, p);
    of_all_.resize(static_cast<std::size_t>(std::accumulate(counts_.begin(), counts_.end(), 0)));
    processes_->gather(r.data(), counts_, of_all_.data());
    right_.assign(of_all_.begin(), of_all_.end());
    factor_.solve(right_, 1, solution_);
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = static_cast<float>(-solution_[first_ + i]);
  }

  int levels() const { return factorised_ ? 1 : multigrid_.levels(); }
  double operator_complexity() const { return factorised_ ? 1 : multigrid_.operator_complexity(); }
  std::size_t bytes() const {
    return (factorised_ ? static_cast<std::size_t>(factor_.bytes()) : multigrid_.bytes()) +
           sizeof(double) * (right_.size() + solution_.size());
  }

 private:
  /// \return  false: it is not positive definite, as where convection is stronger than the inertia of a step, or does not fit
  bool factorise(const CsrMatrix<double>& own, const ShareOfNumbers& share) {
    SparseRows rows = gather_rows({1, own.offsets, own.indices, own.values}, share);
    const CsrMatrix<double> s{rows.rows(), std::move(rows.offsets), std::move(rows.columns), std::move(rows.values)};
    first_ = static_cast<std::size_t>(share.first);
    counts_.clear();
    for (const std::int64_t count : share.processes->gather(std::int64_t{own.rows()}))
      counts_.push_back(static_cast<int>(count));
    const CsrMatrix<double> other = transposed(s);
    assert(other.indices == s.indices);
    SparseMatrix a;
    a.offsets.assign(s.offsets.begin(), s.offsets.end());
    a.rows.assign(s.indices.begin(), s.indices.end());
    a.values.resize(s.values.size());
    for (std::size_t at = 0; at < a.values.size(); ++at) a.values[at] = -0.5 * (s.values[at] + other.values[at]);
    bool failed = false;
    try {
      factor_.factorise(a);
    } catch (const ConvergenceError&) {
      failed = true;
    } catch (const OutOfMemory&) {
      failed = true;
    }
    if (processes_->any(failed)) return false;
    factor_.reduce_precision(a);
    return true;
  }

  bool factorised_ = false;
  CholeskySolver factor_;
  ScalarMultigrid multigrid_;
  const Communicator* processes_ = &Communicator::alone();
  std::vector<int> counts_;  ///< rows of each process
  std::size_t first_ = 0;    ///< own row among all
  std::vector<float> of_all_;
  std::vector<double> right_, solution_;
};

}  // namespace fsi
