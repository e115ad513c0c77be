#pragma once

#include "time/restart_archive.hpp"

namespace fsi {

/// Bounds of the lengths of steps.
struct StepLimits {
  double first = 0;     ///< ms, at the start and after each jump of the load
  double smallest = 0;  ///< ms
  double largest = 0;   ///< ms
};

/// Chooses the lengths of steps from estimates of their error by a digital filter, H0211 of [Soderlind2003]: with the
/// error e of a step over the allowed one, which goes like the length to the power k,
///   dt_new = dt 0.9 (e e_before)^(-1/(2k)) (dt / dt_before)^(-1/2),
/// no more than twice and no less than a fifth of dt. Lengths are rounded down to powers of 2^(1/4) times the first
/// one, and grow by two such rungs at least: a step keeps its length, and the Jacobian made for it, while it is about
/// right.
class StepSizeController {
 public:
  StepSizeController(const StepLimits& limits, int order);

  /// Length that the next step should have at most, ms.
  double wanted() const { return wanted_; }

  /// The load has jumped: earlier estimates no longer count.
  void restart();
  /// A step of this length (ms) whose error could not be estimated was accepted.
  void accept(double length);
  /// A step was accepted with an error of `error` times the allowed one.
  void accept(double length, double error);
  /// A step was rejected for its error. \returns false when no smaller one is allowed
  bool reject(double length, double error);
  /// A step found no solution.
  void fail(double length);

  /// For a restart.
  void keep(RestartArchive& archive);

 private:
  /// The highest rung not above a length, within the limits.
  double rung(double length) const;

  StepLimits limits_;
  int order_;
  double wanted_;
  double error_before_ = 0;  ///< of the last accepted step; 0: none
  double length_before_ = 0;
  bool held_ = false;  ///< the last step was rejected or failed: the next does not grow
};

}  // namespace fsi
