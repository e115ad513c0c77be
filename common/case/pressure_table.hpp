#pragma once

#include <limits>
#include <utility>
#include <vector>

namespace fsi {

/// Pressure, flow rate or another load over time. Linear between points, constant before the first and after the last.
/// A periodic table holds for times from 0 to its period, and repeats in each period that follows.
struct PressureTable {
  std::vector<std::pair<double, double>> points;  ///< (ms, kPa, ...), times not decreasing; equal times: a jump
  double period{};                                ///< ms; 0: not periodic. No point lies beyond it

  /// Mean over [from, to] ms: the load of a step, so that the impulse does not depend on the time step. 0 without
  /// points.
  double mean(double from, double to) const;
  /// Value at a time; at a jump the one before it. A periodic table has at 0 the value of the period's end.
  double at(double time) const;
  /// Times at which it jumps, ms, ascending; of a periodic one those up to `until`, with ends of periods that jump.
  /// Without `until` those of one period.
  std::vector<double> jumps(double until = std::numeric_limits<double>::infinity()) const;
  /// Number of jumps in a period, the one at its end included.
  std::size_t jumps_in_period() const;
  double at_end() const { return points.empty() ? 0.0 : points.back().second; }

 private:
  double integral(double from, double to) const;  ///< as if it were not periodic
  std::vector<double> jumps_of_points() const;
};

}  // namespace fsi
