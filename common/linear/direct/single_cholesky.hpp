#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algebra/panel_matrix.hpp"

namespace fsi {

/// Factors P^T L D L^T P = A of a symmetric positive definite matrix in single precision, L of unit diagonal, P a permutation:
/// half the memory of double ones. Solutions have a residual of about 1e-6 of the right-hand side.
class SingleCholesky {
 public:
  /// \param factor  G of G G^T = P A P^T, by supernodes
  /// \param order   row of A that is row i of G
  SingleCholesky(const Supernodes& factor, const std::int64_t* order);

  /// x = A^-1 b for `count` right-hand sides, one behind the other. One thread at a time.
  void solve(const double* b, int count, double* x) const;

  std::size_t bytes() const;

 private:
  PanelMatrix lower_;
  std::vector<float> pivots_;  ///< D^-1
  std::vector<int> order_;
  mutable std::vector<float> y_;
};

}  // namespace fsi
