#include <gtest/gtest.h>

#include <cmath>

#include "partitioned/divergence.hpp"

namespace fsi::test {

namespace {

/// Residuals start * factor^k; returns after how many the monitor speaks, 0: it does not in 1000.
int speaks_after(DivergenceMonitor& monitor, double start, double factor) {
  for (int k = 0; k < 1000; ++k)
    if (monitor.diverges(start * std::pow(factor, k))) return k + 1;
  return 0;
}

TEST(DivergenceMonitor, SpeaksWhenResidualsGrow) {
  DivergenceMonitor monitor;
  monitor.start();
  EXPECT_EQ(speaks_after(monitor, 1e-3, 2.0), 1 + 20 + 3) << "2^4 is the first power of two above ten";
  monitor.start();
  EXPECT_GT(speaks_after(monitor, 1e-3, 1.02), 100) << "slow growth could be a hump";
}

TEST(DivergenceMonitor, IsSilentWhileTheyFallOrComeBack) {
  DivergenceMonitor monitor;
  monitor.start();
  EXPECT_EQ(speaks_after(monitor, 1.0, 0.99), 0);
  monitor.start();
  for (int k = 0; k < 400; ++k) EXPECT_FALSE(monitor.diverges(k % 10 == 0 ? 1.0 : 1e6)) << k;
}

TEST(DivergenceMonitor, ForgetsTheLastStep) {
  DivergenceMonitor monitor;
  monitor.start();
  monitor.diverges(1e-9);
  monitor.start();
  for (int k = 0; k < 50; ++k) EXPECT_FALSE(monitor.diverges(1.0));
}

TEST(AlternationMonitor, SpeaksAtTheThirdGrowingMissInARow) {
  AlternationMonitor monitor;
  EXPECT_FALSE(monitor.alternates(1, 4));
  EXPECT_FALSE(monitor.alternates(2, 4));
  EXPECT_TRUE(monitor.alternates(3, 4));
}

TEST(AlternationMonitor, IsSilentWhenMissesShrinkOrStaySmall) {
  AlternationMonitor monitor;
  for (int step = 0; step < 20; ++step) EXPECT_FALSE(monitor.alternates(std::pow(0.9, step), 4)) << "a decaying one";
  for (int step = 0; step < 20; ++step) EXPECT_FALSE(monitor.alternates(step, 0.3)) << "a growing wave, well predicted";
}

TEST(AlternationMonitor, GoesOnAfterARestart) {
  AlternationMonitor monitor, again;
  monitor.alternates(1, 4);
  monitor.alternates(2, 4);
  again.set(monitor.steps(), monitor.last_gap());
  EXPECT_TRUE(again.alternates(3, 4));
}

TEST(VelocityGapMonitor, SpeaksAfterEightStepsApart) {
  VelocityGapMonitor monitor(0.5);
  for (int step = 1; step < 8; ++step) EXPECT_FALSE(monitor.comes_apart(0.6, 1)) << step;
  EXPECT_TRUE(monitor.comes_apart(0.6, 0.1)) << "measured by the largest movement, not the last";
  EXPECT_DOUBLE_EQ(monitor.last(), 0.6);
}

TEST(VelocityGapMonitor, IsSilentAfterAJumpAndWhenMotionDiesAway) {
  VelocityGapMonitor monitor(0.5);
  for (const double gap : {4.5, 1.6, 1.1, 0.6, 0.51}) EXPECT_FALSE(monitor.comes_apart(gap, 1)) << "a start";
  for (int step = 0; step < 40; ++step)
    EXPECT_FALSE(monitor.comes_apart(2 * std::pow(0.7, step + 5), std::pow(0.7, step + 5))) << "it swings, and decays";
}

TEST(VelocityGapMonitor, GoesOnAfterARestart) {
  VelocityGapMonitor monitor(0.5), again(0.5);
  monitor.comes_apart(0.1, 1);
  for (int step = 0; step < 7; ++step) monitor.comes_apart(0.6, 0.2);
  again.set(monitor.steps(), monitor.largest_movement());
  EXPECT_TRUE(again.comes_apart(0.6, 0.2));
}

}  // namespace

}  // namespace fsi::test
