#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "derived/period_change.hpp"

namespace fsi {
namespace {

constexpr double period = 4;  // ms

/// One opening and two nodes of the plane. All swing about a mean, and what is left of their start dies away.
PeriodicValues decaying(double time, double turn = 0) {
  const double phase = 2 * M_PI * time / period, left = std::exp(-time / period);
  const double x = 1 + 0.5 * std::sin(phase) + left, y = 0.2 * std::cos(phase);
  const double c = std::cos(turn), s = std::sin(turn);
  return {{10 + 2 * std::sin(phase) + left},
          {3 * std::cos(phase) - 2 * left},
          {c * x - s * y, s * x + c * y, 2 * (c * x - s * y), 2 * (s * x + c * y)}};
}

std::vector<PeriodChange> changes(double step, double end, double turn = 0) {
  PeriodComparison comparison(period, 1, 2);
  std::vector<PeriodChange> found;
  for (int i = 0; i * step <= end * (1 + 1e-12); ++i)
    if (const auto extremes = comparison.add(i * step, decaying(i * step, turn)))
      found.push_back(change_of(*extremes, comparison.last_end()));
  return found;
}

TEST(PeriodChange, IsTheLargestDifferenceAtEqualPhasesOverTheRange) {
  const auto found = changes(period / PeriodComparison::phases, 4 * period);
  ASSERT_EQ(found.size(), 3u) << "the first period has none before it";
  for (std::size_t p = 0; p < found.size(); ++p) {
    const double start = static_cast<double>(p + 1) * period;
    EXPECT_DOUBLE_EQ(found[p].end, start + period);
    // What is left differs most at the beginning of a period, by so much:
    const double difference = std::exp(-static_cast<double>(p)) - std::exp(-static_cast<double>(p + 1));
    double low = 1e9, high = -1e9, low_flow = 1e9, high_flow = -1e9, swing = 0;
    const auto first = decaying(start);
    for (int i = 0; i < PeriodComparison::phases; ++i) {
      const auto values = decaying(start + i * period / PeriodComparison::phases);
      low = std::min(low, values.pressures[0]);
      high = std::max(high, values.pressures[0]);
      low_flow = std::min(low_flow, values.flows[0]);
      high_flow = std::max(high_flow, values.flows[0]);
      swing = std::max(swing, std::hypot(values.displacement[2] - first.displacement[2],
                                         values.displacement[3] - first.displacement[3]));
    }
    EXPECT_NEAR(found[p].pressure, difference / (high - low), 1e-12);
    EXPECT_NEAR(found[p].flow, 2 * difference / (high_flow - low_flow), 1e-12);
    EXPECT_NEAR(found[p].displacement, 2 * difference / swing, 1e-12);
    EXPECT_DOUBLE_EQ(found[p].largest(), std::max({found[p].pressure, found[p].flow, found[p].displacement}));
  }
}

TEST(PeriodChange, IsTheSameWithShorterStepsThatMissThePhases) {
  const auto exact = changes(period / PeriodComparison::phases, 3 * period), missed = changes(0.0137, 3.01 * period);
  ASSERT_EQ(exact.size(), 2u);
  ASSERT_EQ(missed.size(), 2u);
  for (std::size_t p = 0; p < 2; ++p) {
    EXPECT_NEAR(missed[p].pressure, exact[p].pressure, 1e-3 * exact[p].pressure);
    EXPECT_NEAR(missed[p].displacement, exact[p].displacement, 1e-3 * exact[p].displacement);
  }
}

TEST(PeriodChange, DoesNotDependOnTheFrame) {
  const auto straight = changes(0.1, 3 * period), turned = changes(0.1, 3 * period, 0.7);
  for (std::size_t p = 0; p < 2; ++p) EXPECT_NEAR(turned[p].displacement, straight[p].displacement, 1e-12);
}

TEST(PeriodChange, OfWhatRestsIsNone) {
  PeriodComparison comparison(period, 1, 2);
  std::optional<PeriodComparison::Extremes> last;
  for (int i = 0; i <= 2 * PeriodComparison::phases; ++i)
    last = comparison.add(i * period / PeriodComparison::phases, {{10 + 1e-9 * (i % 3)}, {0}, {}});
  ASSERT_TRUE(last);
  const PeriodChange change = change_of(*last, 8);
  EXPECT_LT(change.pressure, 1e-6) << "its range counts as a thousandth of its size";
  EXPECT_EQ(change.flow, 0);
  EXPECT_EQ(change.displacement, 0);
}

TEST(PeriodChange, GoesOnAfterARestart) {
  const double step = 0.1;
  const auto whole = changes(step, 3 * period);
  PeriodComparison before(period, 1, 2), after(period, 1, 2);
  int i = 0;
  for (; i * step < 1.3 * period; ++i) before.add(i * step, decaying(i * step));
  auto memory = memory_of(before);
  memory.turn();
  after.keep(memory);
  std::vector<PeriodChange> found;
  for (; i * step <= 3 * period * (1 + 1e-12); ++i)
    if (const auto extremes = after.add(i * step, decaying(i * step)))
      found.push_back(change_of(*extremes, after.last_end()));
  ASSERT_EQ(found.size(), whole.size());
  for (std::size_t p = 0; p < found.size(); ++p) {
    EXPECT_EQ(found[p].pressure, whole[p].pressure);
    EXPECT_EQ(found[p].displacement, whole[p].displacement);
  }
}

}  // namespace
}  // namespace fsi
