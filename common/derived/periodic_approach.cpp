#include "derived/periodic_approach.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace fsi {

namespace {

constexpr double settled = 0.02;  // change of a contraction from period to period
constexpr double noise = 1e-3;    // of the change asked for: a solver's tolerance has no contraction
constexpr double falling = 0.5;   // of a change that still falls, in two periods

struct Approach {
  double distance = std::numeric_limits<double>::infinity();
  double contraction = std::numeric_limits<double>::quiet_NaN();  ///< what a period leaves of it; NaN: not known
  bool settled = false;
};

/// Factor of the change itself per period, in the mean of the last two. The change of a mean that oscillates while it
/// falls may pass through zero, and gives no contraction.
double fall_of_change(const std::vector<PeriodChange>& changes, std::size_t period) {
  const double last = changes[period].largest();
  if (period == 0) return std::numeric_limits<double>::infinity();
  return period < 2 ? last / changes[period - 1].largest() : std::sqrt(last / changes[period - 2].largest());
}

/// Approach of quantity q after a period, given by its number, from the last two contractions.
Approach observed_approach(const std::vector<PeriodChange>& changes, std::size_t period, std::size_t q,
                           const PeriodicDemand& demand) {
  Approach approach;
  const double change = changes[period].mean[q], last = changes[period].contraction[q];
  const double before = period > 0 ? changes[period - 1].contraction[q] : last;
  approach.settled = std::abs(last - before) <= settled;
  if (!std::isnan(last)) {
    const double observed = std::isnan(before) ? last : std::max(last, before);
    approach.contraction = approach.settled
                               ? observed
                               : std::max(std::min(observed, fall_of_change(changes, period)), demand.law_contraction);
    if (approach.contraction < 1)  // else it does not fall
      approach.distance = change * std::max(0.0, approach.contraction) / (1 - approach.contraction);
  }
  if (change <= noise * demand.largest) approach.distance = change;
  return approach;
}

/// The same, no nearer than the slowest law comes from the distance of a period before: the change of two transients
/// passes through zero where the slower one takes over.
Approach approach_of(const std::vector<PeriodChange>& changes, std::size_t q, const PeriodicDemand& demand) {
  const std::size_t last = changes.size() - 1;
  Approach approach = observed_approach(changes, last, q, demand);
  if (approach.settled || last == 0) return approach;
  const double earlier = observed_approach(changes, last - 1, q, demand).distance;
  if (std::isfinite(earlier)) approach.distance = std::max(approach.distance, demand.law_contraction * earlier);
  return approach;
}

/// Whether the change of the last three periods does not fall.
bool stays(const std::vector<PeriodChange>& changes) {
  const std::size_t count = changes.size();
  if (count < 3) return false;
  return changes[count - 1].largest() >= falling * std::max(changes[count - 2].largest(), changes[count - 3].largest());
}

}  // namespace

PeriodicStanding standing_of(const std::vector<PeriodChange>& changes, const PeriodicDemand& demand) {
  PeriodicStanding standing;
  if (changes.empty()) return standing;
  const PeriodChange& last = changes.back();
  standing.change = last.largest();
  double farthest = 0;
  std::optional<double> contraction;
  for (std::size_t q = 0; q < 3; ++q) {
    const Approach approach = approach_of(changes, q, demand);
    if (approach.distance >= farthest && !std::isnan(approach.contraction)) contraction = approach.contraction;
    farthest = std::max(farthest, approach.distance);
  }
  standing.contraction = contraction;
  if (std::isfinite(farthest)) standing.distance = farthest;
  const bool near = farthest <= demand.largest;
  standing.reached = near && standing.change <= demand.largest;
  standing.limited_by_steps = near && !standing.reached && !demand.steps_repeat && stays(changes);
  if (!near && std::isfinite(farthest) && contraction && *contraction > 0)
    standing.more_periods = static_cast<int>(std::ceil(std::log(demand.largest / farthest) / std::log(*contraction)));
  return standing;
}

}  // namespace fsi
