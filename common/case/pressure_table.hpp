#pragma once

#include <limits>
#include <utility>
#include <vector>

namespace fsi {

/// Pressure over time, or a rate of flow. Between table points linear; before the first point its value, after the last
/// point its value. A periodic one holds for times from 0 to its period, and again for each period that follows.
struct PressureTable {
  std::vector<std::pair<double, double>> points;  ///< (ms, kPa), times not decreasing; equal times make a jump
  double period{};                                ///< ms; 0: not periodic. No point lies beyond it

  /// Mean pressure over [from, to] in kPa: the load of a step, so that the impulse does not depend on the time step.
  double mean(double from, double to) const;
  /// Value at a time, where it jumps the one before the jump.
  double at(double time) const;
  /// Times at which it jumps, ms, ascending; of a periodic one those up to `until`, the ends of periods among them.
  std::vector<double> jumps(double until = std::numeric_limits<double>::infinity()) const;
  /// Jumps in a period, that at its end counted.
  std::size_t jumps_in_period() const;
  double at_end() const { return points.empty() ? 0.0 : points.back().second; }

 private:
  double integral(double from, double to) const;  ///< as if it were not periodic
  std::vector<double> jumps_of_points() const;
};

}  // namespace fsi
