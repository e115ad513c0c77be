#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace fsi {

/// Notices an iteration that runs away: its last `window` residuals are all more than `growth` times the smallest one
/// before them. Methods that converge, but not monotonically, come back sooner.
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

/// Notices a march without iterations that its added mass has made unstable: each step then throws the wall to the
/// other side and further than the last, so that it misses the extrapolated displacement by more than the displacement
/// itself, three times at least. In a march that is stable the two differ by the order of the extrapolation.
class AlternationMonitor {
 public:
  static constexpr int most_steps = 3;  ///< in a row: a jump of the load misses once

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

/// Notices a march without iterations in which fluid and wall have come apart: over `most_steps` steps in a row their
/// velocities on the interface differ by more than `bound` times the largest of the march. Displacements alone do not
/// show it, their differences weigh in the pressure with 1/step^2. A jump of the load upsets a sound march for less.
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
  /// Of the last step, over the largest velocity so far.
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
