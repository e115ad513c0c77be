#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

/// The mean around a time of values linear between phases: of the half of a period's first phase that is behind the start alone.
PeriodicValues around(double time) {
  constexpr double spacing = period / PeriodComparison::phases;
  const auto now = decaying(time), before = decaying(time - spacing), behind = decaying(time + spacing);
  const double first = time > 0 ? 1.0 / 6 : 0, middle = time > 0 ? 4.0 / 6 : 2.0 / 3,
               last = time > 0 ? 1.0 / 6 : 1.0 / 3;
  const auto mean = [&](const std::vector<double>& a, const std::vector<double>& b, const std::vector<double>& c) {
    std::vector<double> values(b.size());
    for (std::size_t i = 0; i < b.size(); ++i) values[i] = first * a[i] + middle * b[i] + last * c[i];
    return values;
  };
  return {mean(before.pressures, now.pressures, behind.pressures), mean(before.flows, now.flows, behind.flows),
          mean(before.displacement, now.displacement, behind.displacement)};
}

TEST(PeriodChange, IsTheLargestDifferenceAtEqualPhasesOverTheRange) {
  const auto found = changes(period / PeriodComparison::phases, 4 * period);
  ASSERT_EQ(found.size(), 3u) << "the first period has none before it";
  for (std::size_t p = 0; p < found.size(); ++p) {
    const double start = static_cast<double>(p + 1) * period;
    EXPECT_DOUBLE_EQ(found[p].end, start + period);
    double difference = 0, flow_difference = 0, moved = 0, low = 1e9, high = -1e9, low_flow = 1e9, high_flow = -1e9,
           swing = 0, mean = 0;
    std::array<double, 2> mean_move{};
    const auto first = around(start);
    for (int i = 0; i < PeriodComparison::phases; ++i) {
      const double time = start + i * period / PeriodComparison::phases;
      const auto values = around(time), before = around(time - period);
      if (p > 0 || i > 0) {  // the first of all has half of its surroundings
        difference = std::max(difference, std::abs(values.pressures[0] - before.pressures[0]));
        flow_difference = std::max(flow_difference, std::abs(values.flows[0] - before.flows[0]));
        moved = std::max(moved, std::hypot(values.displacement[2] - before.displacement[2],
                                           values.displacement[3] - before.displacement[3]));
      }
      for (int k = 0; k < 2; ++k)
        mean_move[k] += (values.displacement[2 + k] - before.displacement[2 + k]) / PeriodComparison::phases;
      mean += (values.pressures[0] - before.pressures[0]) / PeriodComparison::phases;
      low = std::min(low, values.pressures[0]);
      high = std::max(high, values.pressures[0]);
      low_flow = std::min(low_flow, values.flows[0]);
      high_flow = std::max(high_flow, values.flows[0]);
      swing = std::max(swing, std::hypot(values.displacement[2] - first.displacement[2],
                                         values.displacement[3] - first.displacement[3]));
    }
    EXPECT_NEAR(found[p].pressure, difference / (high - low), 1e-12);
    EXPECT_NEAR(found[p].flow, flow_difference / (high_flow - low_flow), 1e-12);
    EXPECT_NEAR(found[p].displacement, moved / swing, 1e-12);
    EXPECT_DOUBLE_EQ(found[p].largest(), std::max({found[p].pressure, found[p].flow, found[p].displacement}));
    EXPECT_NEAR(found[p].mean[0], std::abs(mean) / (high - low), 1e-12);
    EXPECT_NEAR(found[p].mean[2], std::hypot(mean_move[0], mean_move[1]) / swing, 1e-12);
    for (const double left : found[p].contraction) {
      if (p == 0)
        EXPECT_TRUE(std::isnan(left)) << "it takes two changes";
      else
        EXPECT_NEAR(left, std::exp(-1), p == 1 ? 5e-3 : 1e-12)
            << "the first of all phases has half of its surroundings";
    }
  }
}

TEST(PeriodChange, IsTheSameWithShorterStepsThatMissThePhases) {
  const auto exact = changes(period / PeriodComparison::phases / 8, 3 * period),
             missed = changes(0.0137, 3.01 * period);
  ASSERT_EQ(exact.size(), 2u);
  ASSERT_EQ(missed.size(), 2u);
  for (std::size_t p = 0; p < 2; ++p) {
    EXPECT_NEAR(missed[p].pressure, exact[p].pressure, 1e-3 * exact[p].pressure);
    EXPECT_NEAR(missed[p].displacement, exact[p].displacement, 1e-3 * exact[p].displacement);
  }
}

/// A flow that rises and falls linearly is driven by a pressure that jumps, of which bdf2 sees the jumps earlier or later and
/// half of them too high or not, as its steps fall. Step by step periods differ by a quarter of the range.
TEST(PeriodChange, OfAKinkThatStepsMeetElsewhereIsSmall) {
  constexpr double step = period * 3 / 800;
  const auto flow = [](double time) { return std::abs(std::fmod(time, period) - period / 2); };
  PeriodComparison comparison(period, 1, 2);
  double largest = 0;
  int count = 0;
  for (int i = 0; i * step < 6 * period; ++i) {
    const double t = i * step, q = flow(t);
    const double rate = i < 2 ? -1 : (1.5 * q - 2 * flow(t - step) + 0.5 * flow(t - 2 * step)) / step;
    if (const auto extremes = comparison.add(t, {{rate}, {q}, {}})) {
      largest = std::max(largest, change_of(*extremes, comparison.last_end()).largest());
      ++count;
    }
  }
  EXPECT_EQ(count, 4);
  EXPECT_LT(largest, 0.006);
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
  auto memory = archive_of(before);
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
    EXPECT_EQ(found[p].mean, whole[p].mean);
  }
  EXPECT_EQ(found[1].contraction, whole[1].contraction);
}

}  // namespace
}  // namespace fsi
