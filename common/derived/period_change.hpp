#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "parallel/communicator.hpp"
#include "time/restart_archive.hpp"

namespace fsi {

/// What is compared from period to period.
struct PeriodicValues {
  std::vector<double> pressures;     ///< of openings, kPa
  std::vector<double> flows;         ///< outward, of the same, mm^3/ms
  std::vector<double> displacement;  ///< vectors per node between fluid and wall, mm; empty without wall
};

/// How a period differs from the one before: for each quantity the largest difference at equal phases, over its range
/// within the period. The range of pressures and flows is the largest that an opening has, that of the displacement its
/// largest distance from where it is at the period's beginning. A range below `least_range` of the largest value counts
/// as that, so that what has come to rest has not changed.
struct PeriodChange {
  double end = 0;  ///< ms, of the period
  double pressure = 0, flow = 0, displacement = 0;
  /// Of the means over the period, likewise: pressure, flow, displacement.
  std::array<double, 3> mean{};
  /// This change of the means over that of the period before, NaN where there is none to compare with: what a transient
  /// of one time constant tau leaves of itself in a period, exp(-T/tau).
  std::array<double, 3> contraction{};

  double largest() const;
};

/// Compares each period, 0 to T, T to 2 T, ..., with the one before, at `phases` equally spaced phases. Values are
/// added at the end of each step, of any length, and taken as linear in time between these. The value of a phase is
/// their mean around it, with a weight that falls linearly to zero at the phases beside it. Where steps do not fit the
/// period, kinks of a table fall on other places of the steps in each period. That moves a pressure by a part of its
/// jump there, but such a mean only by that times the square of step over phase.
class PeriodComparison {
 public:
  static constexpr int phases = 32;
  static constexpr double least_range = 1e-3;

  /// Differences and ranges of a period, of the values here. Those of several processes combine by their maximum.
  struct Extremes {
    static constexpr double none = -std::numeric_limits<double>::max();
    std::array<double, 3> difference{};  ///< of pressures, flows, displacement
    std::array<double, 3> range{};
    std::array<double, 3> size{};                     ///< largest values
    std::array<double, 3> mean_difference{};          ///< of means over the period
    std::array<double, 3> product{none, none, none};  ///< largest of a mean's change times its change before
    std::array<double, 3> square{};                   ///< largest of the changes before; 0: there are none
  };

  /// \param period      T, ms
  /// \param openings    number of openings with pressures and flows
  /// \param components  of a displacement vector
  PeriodComparison(double period, std::size_t openings, int components)
      : period_(period), openings_(openings), components_(components) {}

  /// Values at a time (ms), as many each time. The first call begins; a time that is not later than the last has no
  /// effect. \returns the extremes of the period that has ended, if one has after another whole one
  std::optional<Extremes> add(double time, const PeriodicValues& values);
  /// ms, of the last period that has ended.
  double last_end() const {
    const std::int64_t ended = passed_ / phases;
    return period_ * static_cast<double>(ended);
  }

  /// Combines the extremes of the period so far over all processes: before keep() writes. Collective.
  void share(const Communicator& processes);
  /// Saves or recalls the state, bit for bit. Where the earlier run had none of this period it begins anew and warns.
  void keep(RestartArchive& archive);

 private:
  /// Numbers of openings, pressures before flows, and of the displacement.
  struct Numbers {
    std::vector<double> scalars, vectors;
  };
  /// The weighted mean around a phase, as far as it has been seen.
  struct Around {
    double weight = 0;  ///< ms
    Numbers sum;        ///< times ms
  };

  /// Adds values that are linear in time between two times, in shares of the interval between two phases.
  void take(double from, double to, const PeriodicValues& first, const PeriodicValues& last);
  /// Completes a phase: compares it with that of the period before, and stores it.
  void pass(int phase, const Around& around);
  /// The change of the means over the period that has ended.
  void compare_means();

  double period_;
  std::size_t openings_;
  int components_;
  bool begun_ = false;
  double time_ = 0;                   ///< ms, of the last values
  std::int64_t passed_ = 0;           ///< phases since time 0 that have been passed
  std::int64_t known_ = 0;            ///< of the last ones, how many have been seen, two periods at most
  PeriodicValues now_;                ///< at time_
  Around before_, behind_;            ///< the phase that was passed last, and the next one
  Numbers at_phases_;                 ///< the values of a period, by phase
  Numbers mean_, mean_change_;        ///< of the last period, and from the one before it
  std::int64_t means_ = 0;            ///< periods in a row whose means are known: 0, 1, or 2 where a change of them is
  std::vector<double> least_, most_;  ///< pressures and flows in the period
  Extremes extremes_;                 ///< of the period so far
};

/// The change that these extremes amount to.
PeriodChange change_of(const PeriodComparison::Extremes& extremes, double end);

}  // namespace fsi
