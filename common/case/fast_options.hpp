#pragma once

#include <cstdint>
#include <optional>

namespace fsi {

/// Options of the linear solver `fast`, here so that case files can set them. Defaults by measurement
/// (docs/solvers.md).
struct FastOptions {
  /// Unknowns below which the matrix is factorised; without it standard_direct_below().
  std::optional<std::int64_t> direct_below;
  int max_iterations = 400;  ///< of GMRES in one solve, before the preconditioner is strengthened
  int restart = 50;          ///< iterations between two residuals in double precision, at most
  int momentum_sweeps = 1;   ///< symmetric Gauss-Seidel sweeps on the momentum equations
  int strong_sweeps = 8;     ///< the same when the preconditioner is strengthened
  /// Factors that leave the mesh motion out solve to `exact_to`, as factors of the whole would, whatever is asked for. Set where
  /// there is a network: increments that are less exact send Newton's method astray among valves that open and close.
  bool exact = false;
  static constexpr double exact_to = 1e-6;

  /// Unknowns below which a sparse factorisation is quicker: factors of a plane graph hardly fill in. In two dimensions a
  /// coupled system of `judged_from` unknowns or more is iterated all the same where its wall's stiffness
  /// over inertia is less than `judged_below`: without the seconds and the memory of factors, which a run has to earn back
  /// by quicker solves (2.7: not in 200 steps; 5.3: in 150; 9: in 50).
  static constexpr std::int64_t judged_from = 10000;
  static constexpr double judged_below = 4;
  /// \param dimension  components of a velocity
  static constexpr std::int64_t standard_direct_below(int dimension) { return dimension == 2 ? 200000 : 2000; }
  /// Whether it is the wall that decides.
  /// \param unknowns  of both media and the mesh motion
  bool are_judged(int dimension, std::int64_t unknowns) const {
    return dimension == 2 && !direct_below && unknowns >= judged_from && unknowns < standard_direct_below(dimension);
  }
};

}  // namespace fsi
