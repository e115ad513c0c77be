#pragma once

#include <vector>

#include "linear/krylov/krylov.hpp"

namespace fsi {

/// The stationary iteration x += M^-1 (b - A x): a preconditioner, e.g. a multigrid cycle, as a solver of its own. On
/// one process: norms are not summed over several.
class Richardson {
 public:
  /// Arguments as for Gmres::solve, `inverse` required; options.restart is unused. Stops as diverged when the residual
  /// exceeds a million times the first one.
  KrylovReport solve(const LinearOperator& a, const LinearOperator& inverse, const std::vector<double>& b,
                     std::vector<double>& x, const KrylovOptions& options = {});
  std::size_t bytes() const { return (residual_.size() + correction_.size()) * sizeof(double); }

 private:
  std::vector<double> residual_, correction_;
};

}  // namespace fsi
