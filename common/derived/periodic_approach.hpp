#pragma once

#include <optional>
#include <vector>

#include "derived/period_change.hpp"

namespace fsi {

/// The conditions on a run that is to become periodic.
struct PeriodicDemand {
  double largest = 0.01;       ///< change from period to period, and distance to the periodic state, of the range
  double law_contraction = 0;  ///< exp(-T/tau) of the slowest law of an opening by itself; 0: none has a time constant
  bool steps_repeat = true;    ///< each period has its steps at the same phases
};

/// Where a run stands after a period.
struct PeriodicStanding {
  double change = 0;                  ///< from the period before, the largest of the quantities, of their ranges
  std::optional<double> distance;     ///< of the means to those of the periodic state, likewise; empty: not known
  std::optional<double> contraction;  ///< factor of it per period, for the quantity farthest off; empty: not known
  bool reached = false;               ///< change and distance are as small as asked
  bool limited_by_steps = false;      ///< only the distance is; the change does not fall, as steps do not repeat
  std::optional<int> more_periods{};  ///< until the distance is as small as asked, about; empty: not known
};

/// Where a run stands after the last of these periods. A transient that falls by lambda each period has
///   d lambda/(1 - lambda)
/// to go after a period that changed by d: 9.5 d behind a Windkessel whose time constant is ten periods. lambda is
/// observed, the larger of the last two. While these differ, the mean oscillates, or faster transients hide slower
/// ones: then lambda is taken as at most the factor by which the change at all phases falls, and at least that of the
/// slowest law by itself. Pressures, flows and displacements are judged separately.
PeriodicStanding standing_of(const std::vector<PeriodChange>& changes, const PeriodicDemand& demand);

}  // namespace fsi
