#pragma once

#include <algorithm>
#include <array>
#include <cmath>
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

/// Notices a march whose steps alternate without end though each is small: second differences of the wall's
/// displacement in time that point against the step's before and are as long. A wave that the time step resolves has
/// neither; an alternation that decays by a few percent a step dies out by itself.
class SawtoothMonitor {
 public:
  static constexpr int most_steps = 10;       ///< in a row
  static constexpr double opposite = -0.9;    ///< cosine between consecutive second differences, at most
  static constexpr double undamped = 0.98;    ///< ratio of their lengths, at least
  static constexpr double noticeable = 0.01;  ///< of the displacement

  /// \param d  displacement of the wall in mm at four time levels, the newest first, in nodal arrays of `stride`
  /// numbers
  ///           a node, the last of which is not looked at
  bool persists(const std::array<const std::vector<double>*, 4>& d, std::size_t stride) {
    double here = 0, before = 0, product = 0, size = 0;
    for (std::size_t i = 0; i < d[0]->size(); ++i) {
      if (i % stride == stride - 1) continue;
      const double a = (*d[0])[i] - 2 * (*d[1])[i] + (*d[2])[i], b = (*d[1])[i] - 2 * (*d[2])[i] + (*d[3])[i];
      here += a * a;
      before += b * b;
      product += a * b;
      size += (*d[0])[i] * (*d[0])[i];
    }
    const bool alternates = product < opposite * std::sqrt(here * before) && here > undamped * undamped * before &&
                            here > noticeable * noticeable * size;
    steps_ = alternates ? steps_ + 1 : 0;
    return steps_ >= most_steps;
  }

  int steps() const { return steps_; }
  void set(int steps) { steps_ = steps; }

 private:
  int steps_ = 0;
};

}  // namespace fsi
