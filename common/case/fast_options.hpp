#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "case/preconditioner_list.hpp"

namespace fsi {

/// Options of the linear solver `fast`, here so that case files can set them. Defaults by measurement
/// (docs/guide/solvers.md).
struct FastOptions {
  /// Unknowns below which the matrix is factorised, however stiff a wall is; without it SolverPolicy decides.
  std::optional<std::int64_t> direct_below;
  std::string preconditioner{flow_preconditioner_list[0]};  ///< of velocities and pressures: a name of the list
  int max_iterations = 400;  ///< of GMRES in one solve, before the preconditioner is strengthened
  int restart = 50;          ///< iterations between two residuals in double precision, at most
  int momentum_sweeps = 1;   ///< symmetric Gauss-Seidel sweeps on the momentum equations
  int strong_sweeps = 8;     ///< the same when the preconditioner is strengthened
  /// Factors without the mesh motion solve to `exact_to` at least, as factors of the whole would. Set for cases with a
  /// network: less exact increments mislead Newton's method among valves that open and close.
  bool exact = false;
  static constexpr double exact_to = 1e-6;
};

}  // namespace fsi
