#pragma once

#include <cstdint>

namespace fsi {

/// Options of the linear solver `fast`, here so that case files can set them. Defaults by measurement
/// (docs/solvers.md).
struct FastOptions {
  std::int64_t direct_below = 2000;  ///< unknowns below which a sparse factorisation is quicker
  int max_iterations = 400;          ///< of GMRES in one solve, before the preconditioner is strengthened
  int restart = 50;                  ///< iterations between two residuals in double precision, at most
  int momentum_sweeps = 0;           ///< symmetric Gauss-Seidel sweeps on the momentum equations; 0: chosen
  int strong_sweeps = 8;             ///< the same when the preconditioner is strengthened
};

}  // namespace fsi
