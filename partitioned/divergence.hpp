#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace fsi {

/// Detects a diverging iteration: its last `window` residuals are all more than `growth` times the smallest one before
/// them. Methods that converge, but not monotonically, return below that bound sooner.
class DivergenceMonitor {
 public:
  static constexpr std::ptrdiff_t window = 20;
  static constexpr double growth = 10;

  void start() { residuals_.clear(); }
  /// \returns whether the iteration runs away, this residual being its latest
  bool diverges(double residual) {
    residuals_.push_back(residual);
    if (static_cast<std::ptrdiff_t>(residuals_.size()) <= window) return false;
    const auto recent = residuals_.end() - window;
    return *std::min_element(recent, residuals_.end()) > growth * *std::min_element(residuals_.begin(), recent);
  }

 private:
  std::vector<double> residuals_;
};

/// Detects the added-mass instability of a coupling with one pass a step: the wall then swings to the other side in
/// each step, further than in the last. It is detected by |d~ - d| > |d~|, growing, in `most_steps` steps in a row. In
/// a stable run d~ - d is as small as the error of the extrapolation.
class AlternationMonitor {
 public:
  static constexpr int most_steps = 3;  ///< in a row: a jump of the load misses once

  /// To be called once a step. \returns whether the run has become unstable
  /// \param gap       |d~ - d| of the step, mm
  /// \param relative  the same over |d~|
  bool alternates(double gap, double relative) {
    steps_ = relative > 1 && gap > last_gap_ ? steps_ + 1 : 0;
    last_gap_ = gap;
    return steps_ >= most_steps;
  }

  int steps() const { return steps_; }
  double last_gap() const { return last_gap_; }
  void set(int steps, double last_gap) {
    steps_ = steps;
    last_gap_ = last_gap;
  }

 private:
  int steps_ = 0;
  double last_gap_ = 0;
};

/// Detects fluid and wall coming apart in a coupling with one pass a step: over `most_steps` steps in a row their
/// velocities on the interface differ by more than `bound` times the largest velocity of the run. Displacements alone
/// do not show it, as their differences count in the pressure with 1/step^2. After a jump of the load a stable run
/// recovers in fewer steps.
class VelocityGapMonitor {
 public:
  static constexpr int most_steps = 8;

  explicit VelocityGapMonitor(double bound) : bound_(bound) {}
  /// \param gap       |d~ - d| of the step, mm: the velocities' difference times the time step
  /// \param movement  |d~ - d^{n-1}|, mm: the wall's velocity times the time step
  bool comes_apart(double gap, double movement) {
    largest_movement_ = std::max(largest_movement_, movement);
    last_ = largest_movement_ > 0 ? gap / largest_movement_ : 0;
    steps_ = last_ > bound_ ? steps_ + 1 : 0;
    return steps_ >= most_steps;
  }

  double bound() const { return bound_; }
  /// Velocity difference of the last step over the largest velocity so far.
  double last() const { return last_; }
  int steps() const { return steps_; }
  double largest_movement() const { return largest_movement_; }
  void set(int steps, double largest_movement) {
    steps_ = steps;
    largest_movement_ = largest_movement;
  }

 private:
  double bound_;
  int steps_ = 0;
  double largest_movement_ = 0;
  double last_ = 0;
};

}  // namespace fsi
