#pragma once

#include <vector>

#include "linear/krylov/gmres.hpp"

namespace fsi {

/// Flexible GMRES [Saad1993]: the preconditioner may differ from one iteration to the next (an inner iteration, a
/// K-cycle). Keeps the preconditioned directions too, twice the vectors of Gmres.
class Fgmres {
 public:
  /// Arguments as for Gmres::solve.
  KrylovReport solve(const LinearOperator& a, const LinearOperator& inverse, const std::vector<double>& b,
                     std::vector<double>& x, const KrylovOptions& options = {}) {
    return method_.solve(a, inverse, b, x, options);
  }
  std::size_t bytes() const { return method_.bytes(); }

 private:
  detail::RestartedGmres method_{true};
};

}  // namespace fsi
