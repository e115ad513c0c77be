#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "derived/periodic_approach.hpp"

namespace fsi {
namespace {

constexpr double beat = 4, mean_flow = 2, proximal = 0.1, distal = 3;  // ms, mm^3/ms, kPa ms/mm^3

/// A Windkessel behind a flow Q = Q_0 (1 - cos w t), exactly: C dp/dt = Q - p/R_d.
struct ExactWindkessel {
  double time_constant;  ///< R_d C, ms
  double start;          ///< p at time 0 beyond the periodic state there, kPa
  double fast = 0;       ///< kPa of a transient beside it that falls to e^-1.2 a period
  double w = 2 * M_PI / beat;

  double flow(double t) const { return mean_flow * (1 - std::cos(w * t)); }
  double transient(double t) const { return start * std::exp(-t / time_constant) + fast * std::exp(-1.2 * t / beat); }
  double pressure(double t) const {
    const double wt = w * time_constant, swing = distal * mean_flow / (1 + wt * wt);
    return distal * mean_flow - swing * (std::cos(w * t) + wt * std::sin(w * t)) + transient(t) + proximal * flow(t);
  }
  /// How far the mean of a period, which ends at `end`, is from that of the periodic state.
  double distance_of_mean(double end) const {
    const auto mean = [&](double amplitude, double tau) {
      return amplitude * tau / beat * (std::exp(-(end - beat) / tau) - std::exp(-end / tau));
    };
    return std::abs(mean(start, time_constant) + mean(fast, beat / 1.2));
  }
  double range() const {
    double low = 1e9, high = -1e9;
    for (int i = 0; i < 1000; ++i) {
      const double t = i * beat / 1000, p = pressure(t) - transient(t);
      low = std::min(low, p);
      high = std::max(high, p);
    }
    return high - low;
  }
};

struct Ended {
  int periods;
  double distance;  ///< the exact one of its mean, over the range
  PeriodicStanding standing;
};

Ended run_until_periodic(const ExactWindkessel& windkessel, double law_contraction) {
  PeriodComparison comparison(beat, 1, 2);
  std::vector<PeriodChange> changes;
  const PeriodicDemand demand{0.01, law_contraction, true};
  constexpr int steps = 200;
  for (int i = 0; i < 400 * steps; ++i) {
    const double t = i * beat / steps;
    const auto extremes = comparison.add(t, {{windkessel.pressure(t)}, {windkessel.flow(t)}, {}});
    if (!extremes) continue;
    changes.push_back(change_of(*extremes, comparison.last_end()));
    const PeriodicStanding standing = standing_of(changes, demand);
    if (standing.reached)
      return {static_cast<int>(std::lround(t / beat)), windkessel.distance_of_mean(t) / windkessel.range(), standing};
  }
  return {0, 1, {}};
}

TEST(PeriodicApproach, EndsAtTheDistanceThatIsAskedForHoweverSlowTheWindkessel) {
  for (const double periods : {0.3, 1.0, 5.0, 10.0, 40.0}) {
    const ExactWindkessel windkessel{periods * beat, -6};
    const Ended ended = run_until_periodic(windkessel, std::exp(-1 / periods));
    ASSERT_GT(ended.periods, 0) << periods;
    EXPECT_LE(ended.distance, 0.01) << periods;
    if (periods >= 5) {
      EXPECT_GT(ended.distance, 0.009 * std::exp(-1 / periods)) << "no later than needed, R_d C of " << periods;
      EXPECT_NEAR(*ended.standing.distance, ended.distance, 0.02 * ended.distance) << periods;
      EXPECT_NEAR(*ended.standing.contraction, std::exp(-1 / periods), 1e-3) << periods;
      EXPECT_GT(ended.distance / ended.standing.change, 0.75 * periods)
          << "the change from the period before says less";
    }
  }
}

TEST(PeriodicApproach, FasterTransientsDoNotHideASlowOne) {
  ExactWindkessel windkessel{10 * beat, 0};
  windkessel.start = -0.04 * windkessel.range();
  for (const double fast : {0.5, 2.0, -0.5}) {
    windkessel.fast = fast * std::abs(windkessel.start) * 4;
    const Ended ended = run_until_periodic(windkessel, std::exp(-0.1));
    ASSERT_GT(ended.periods, 0);
    EXPECT_LE(ended.distance, 0.0115) << fast << ", after " << ended.periods;
  }
}

PeriodChange change_by(double all, double mean, double contraction) {
  PeriodChange change;
  change.pressure = all;
  change.mean[0] = mean;
  change.contraction.fill(contraction);
  return change;
}

TEST(PeriodicApproach, TellsWhatStepsLeaveFromATransient) {
  const std::vector<PeriodChange> changes{change_by(0.2, 0.1, NAN), change_by(0.06, 2e-4, 0.002),
                                          change_by(0.05, 3e-4, -0.4), change_by(0.07, 2e-4, 0.2)};
  EXPECT_FALSE(standing_of(changes, {0.01, 0, true}).limited_by_steps) << "steps are the same in each period";
  const PeriodicStanding standing = standing_of(changes, {0.01, 0, false});
  EXPECT_TRUE(standing.limited_by_steps);
  EXPECT_FALSE(standing.reached);
  ASSERT_TRUE(standing.distance);
  EXPECT_LT(*standing.distance, 0.01);
  EXPECT_FALSE(standing_of({changes.begin(), changes.begin() + 2}, {0.01, 0, false}).limited_by_steps);
  EXPECT_FALSE(
      standing_of({change_by(0.2, 0.1, NAN), change_by(0.06, 0.05, 0.5), change_by(0.05, 0.025, 0.5)}, {0.01, 0, false})
          .limited_by_steps)
      << "a transient is left";
}

TEST(PeriodicApproach, IsNotHeldUpByAMeanThatPassesThroughZeroAsItSwings) {
  const std::vector<PeriodChange> changes{change_by(0.08, 0.03, NAN), change_by(0.03, 1e-4, -0.003),
                                          change_by(0.009, 4e-3, -40), change_by(0.003, 3.9e-3, 0.98)};
  EXPECT_TRUE(standing_of({changes.begin(), changes.begin() + 3}, {0.01, 0.5}).reached);
  EXPECT_TRUE(standing_of(changes, {0.01, 0.5}).reached) << "all that changes falls by three in each period";
}

TEST(PeriodicApproach, SaysHowManyPeriodsAreLeft) {
  const PeriodicStanding standing =
      standing_of({change_by(0.02, 0.02, NAN), change_by(0.016, 0.016, 0.8), change_by(0.0128, 0.0128, 0.8)}, {0.01});
  EXPECT_NEAR(*standing.distance, 0.0512, 1e-12);
  EXPECT_EQ(standing.more_periods, 8) << "0.0512 * 0.8^8 = 0.0086, 0.8^7 leaves 0.0107";
  const PeriodicStanding growing = standing_of({change_by(0.02, 0.02, NAN), change_by(0.03, 0.03, 1.5)}, {0.01});
  EXPECT_FALSE(growing.distance);
  EXPECT_FALSE(growing.reached);
}

}  // namespace
}  // namespace fsi
