#pragma once

#include <cassert>
#include <cstddef>
#include <vector>

#include "algebra/csr_matrix.hpp"
#include "base/error.hpp"
#include "host/available_memory.hpp"
#include "linear/amg/scalar_multigrid.hpp"
#include "linear/direct/cholesky_solver.hpp"

namespace fsi {

/// Approximate inverse of the Schur complement S, whose negative is like a Laplacian: one cycle of smoothed aggregation, or
/// a Cholesky factor of the symmetric part of -S in single precision. In the plane factors hardly fill in, and take half
/// of a cycle's time (docs/guide/solvers.md).
class SchurComplementInverse {
 public:
  /// Takes present values. \param factorise  where -S is positive definite; else, and where it is not, by multigrid
  void set_up(const CsrMatrix<double>& s, const ScalarMultigrid::Options& options, bool factorise) {
    factorised_ = factorise && this->factorise(s);
    if (!factorised_) multigrid_.set_up(s, options);
  }

  /// p = S^-1 r, both of one length.
  void apply(const std::vector<float>& r, std::vector<float>& p) {
    if (!factorised_) return multigrid_.cycle(r, p);
    right_.assign(r.begin(), r.end());
    factor_.solve(right_, 1, solution_);
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = static_cast<float>(-solution_[i]);
  }

  int levels() const { return factorised_ ? 1 : multigrid_.levels(); }
  double operator_complexity() const { return factorised_ ? 1 : multigrid_.operator_complexity(); }
  std::size_t bytes() const {
    return (factorised_ ? static_cast<std::size_t>(factor_.bytes()) : multigrid_.bytes()) +
           sizeof(double) * (right_.size() + solution_.size());
  }

 private:
  /// \return  false: it is not positive definite, as where convection is stronger than the inertia of a step, or does not fit
  bool factorise(const CsrMatrix<double>& s) {
    const CsrMatrix<double> other = transposed(s);
    assert(other.indices == s.indices);
    SparseMatrix a;
    a.offsets.assign(s.offsets.begin(), s.offsets.end());
    a.rows.assign(s.indices.begin(), s.indices.end());
    a.values.resize(s.values.size());
    for (std::size_t at = 0; at < a.values.size(); ++at) a.values[at] = -0.5 * (s.values[at] + other.values[at]);
    try {
      factor_.factorise(a);
    } catch (const ConvergenceError&) {
      return false;
    } catch (const OutOfMemory&) {
      return false;
    }
    factor_.reduce_precision(a);
    return true;
  }

  bool factorised_ = false;
  CholeskySolver factor_;
  ScalarMultigrid multigrid_;
  std::vector<double> right_, solution_;
};

}  // namespace fsi
