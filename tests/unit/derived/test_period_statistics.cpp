// Averages of the wall shear stress against integrals in closed form.

#include <gtest/gtest.h>

#include <cmath>

#include "derived/period_statistics.hpp"

namespace fsi {

namespace {

const double two_pi = 2 * std::acos(-1.0);

/// Takes in shear(t) at 0, h, 2 h, ... up to `end`.
template <class Shear>
PeriodStatistics taken_in(double period, double h, double end, Shear shear) {
  PeriodStatistics statistics(period);
  for (int k = 0; k * h <= end * (1 + 1e-12); ++k) statistics.add(k * h, shear(k * h));
  return statistics;
}

TEST(PeriodStatistics, OscillationOfASineIsAHalfAndItsResidenceFinite) {
  const auto s = taken_in(4.0, 4.0 / 256, 4.0, [](double t) {
    return std::vector<double>{0.0, 2 * std::sin(two_pi * t / 4), 0.0};
  });
  ASSERT_TRUE(s.last());
  EXPECT_NEAR(s.last()->mean[0], 2 * 4 / two_pi, 2e-4);  // the trapezoidal rule's, (pi h / T)^2 / 3
  EXPECT_NEAR(s.last()->oscillation[0], 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(s.last()->residence[0], 1 / (PeriodStatistics::smallest_mean * s.last()->mean[0]));
}

TEST(PeriodStatistics, ShearOfOneSignDoesNotOscillate) {
  const auto s = taken_in(4.0, 0.25, 4.0, [](double t) {
    return std::vector<double>{0.0, 0.0, 3 * (1 + std::sin(two_pi * t / 4))};
  });
  ASSERT_TRUE(s.last());
  EXPECT_NEAR(s.last()->mean[0], 3, 1e-13);  // the rule is exact for waves in a whole period
  EXPECT_NEAR(s.last()->oscillation[0], 0, 1e-13);
  EXPECT_NEAR(s.last()->residence[0], 1.0 / 3, 1e-13);
}

TEST(PeriodStatistics, OneHalfForwardsOneQuarterBackwards) {
  // tau = 1 for two thirds of a period and -1 for one: OSI = (1 - 1/3) / 2. Steps end at the jumps.
  PeriodStatistics s(3);
  for (const auto& [t, tau] : {std::pair{0.0, 1.0}, {2.0, 1.0}, {2.0 + 1e-9, -1.0}, {3.0, -1.0}}) s.add(t, {tau, 0, 0});
  ASSERT_TRUE(s.last());
  EXPECT_NEAR(s.last()->oscillation[0], 1.0 / 3, 1e-8);
  EXPECT_NEAR(s.last()->residence[0], 3.0, 1e-7);
}

TEST(PeriodStatistics, ATurningShearCountsAsAVector) {
  const auto s = taken_in(1.0, 1.0 / 64, 1.0, [](double t) {
    return std::vector<double>{std::cos(two_pi * t), std::sin(two_pi * t), 1.0};
  });
  EXPECT_NEAR(s.last()->mean[0], std::sqrt(2.0), 1e-13);
  EXPECT_NEAR(s.last()->oscillation[0], 0.5 * (1 - 1 / std::sqrt(2.0)), 1e-13);
}

TEST(PeriodStatistics, PeriodsMayEndWithinSteps) {
  // tau = t, linear: exact. Period 2 of steps of 0.3: the mean over [2, 4] is 3.
  PeriodStatistics s(2);
  for (int k = 0; k <= 13; ++k) s.add(0.3 * k, {0.3 * k, 0, 0, 0, 0, 0});
  ASSERT_TRUE(s.last());
  EXPECT_NEAR(s.last()->mean[0], 1, 1e-13);
  EXPECT_EQ(s.until(), 2);
  s.add(4.2, {4.2, 0, 0, 0, 0, 0});
  EXPECT_NEAR(s.last()->mean[0], 3, 1e-13);
  EXPECT_EQ(s.last()->mean[1], 0);
  EXPECT_EQ(s.last()->oscillation[1], 0);
  EXPECT_EQ(s.last()->residence[1], 0);
  s.add(9.0, {9.0, 0, 0, 0, 0, 0});  // over several periods in one step
  EXPECT_NEAR(s.last()->mean[0], 7, 1e-13);
  EXPECT_EQ(s.until(), 8);
}

TEST(PeriodStatistics, APeriodThatWasNotSeenFromItsStartDoesNotCount) {
  PeriodStatistics s(2);
  s.add(1.0, {1, 0, 0});
  s.add(2.0, {1, 0, 0});
  EXPECT_FALSE(s.last());
  s.add(4.0, {1, 0, 0});
  EXPECT_TRUE(s.last());
}

TEST(PeriodStatistics, ATimeTakenInAlreadyChangesNothing) {
  PeriodStatistics s(2);
  for (const double t : {0.0, 1.0, 1.0, 2.0, 2.0}) s.add(t, {1 + t, 0, 0});
  EXPECT_NEAR(s.last()->mean[0], 2, 1e-14);
}

TEST(PeriodStatistics, GoesOnFromItsMemoryBitForBit) {
  const auto shear = [](double t) { return std::vector<double>{std::sin(3 * t), 0.2, std::cos(t)}; };
  PeriodStatistics whole(1.3), first(1.3), second(1.3);
  int k = 0;
  for (; k <= 20; ++k) {
    whole.add(0.1 * k, shear(0.1 * k));
    first.add(0.1 * k, shear(0.1 * k));
  }
  WrittenArchive archive = archive_of(first);
  second.keep(archive.turn());
  for (; k <= 40; ++k) {
    whole.add(0.1 * k, shear(0.1 * k));
    second.add(0.1 * k, shear(0.1 * k));
  }
  EXPECT_EQ(archive_of(whole).arrays, archive_of(second).arrays);
}

TEST(PeriodStatistics, LeavesAMemoryOfAnotherPeriod) {
  PeriodStatistics s(1), other(2);
  s.add(0, {1, 0, 0});
  s.add(1, {1, 0, 0});
  WrittenArchive archive = archive_of(s);
  other.keep(archive.turn());
  EXPECT_TRUE(archive_of(other).arrays.empty()) << "it begins anew";
  WrittenArchive none;
  s.keep(none.turn());
  EXPECT_FALSE(archive_of(s).arrays.empty());
}

}  // namespace

}  // namespace fsi
