#include "restart/checkpoint_pace.hpp"

#include <gtest/gtest.h>

namespace fsi::test {

namespace {

/// Seconds that checkpoints take in a run of equal steps, and the longest time between two of them.
struct Account {
  double spent = 0, longest_gap = 0;
  int count = 0;
};

Account account_of(CheckpointPace pace, double step_seconds, double checkpoint_seconds, int steps) {
  Account account;
  double now = 0, last = 0;
  for (int step = 1; step <= steps; ++step) {
    now += step_seconds;
    account.longest_gap = std::max(account.longest_gap, now - last);
    if (!pace.is_due(step, now)) continue;
    now += checkpoint_seconds;
    pace.written(now, checkpoint_seconds);
    account.spent += checkpoint_seconds;
    ++account.count;
    last = now;
  }
  account.spent /= now;
  return account;
}

}  // namespace

TEST(CheckpointPace, TakesAFiftiethOfTheRun) {
  for (const double checkpoint : {0.002, 0.02, 0.3})
    for (const double step : {0.001, 0.09, 0.7}) {
      const Account account = account_of(CheckpointPace({}), step, checkpoint, 20000);
      EXPECT_LE(account.spent, 0.02) << step << " " << checkpoint;
      EXPECT_GT(account.count, 0);
      EXPECT_LE(account.longest_gap, 60 + step);
    }
}

TEST(CheckpointPace, LosesNoMoreThanAMinute) {
  // Checkpoints of three seconds would be 150 s apart by their share.
  const Account account = account_of(CheckpointPace({}), 0.5, 3, 5000);
  EXPECT_LE(account.longest_gap, 60.5);
  EXPECT_NEAR(account.spent, 3 / 63.0, 2e-3);
  // Steps that are longer than that leave one each.
  EXPECT_EQ(account_of(CheckpointPace({}), 90, 3, 10).count, 10);
}

TEST(CheckpointPace, WritesAsOftenAsTheCaseSays) {
  CheckpointRule rule;
  rule.seconds = 10;
  EXPECT_EQ(account_of(CheckpointPace(rule), 1, 0, 100).count, 10);
  rule.seconds = 0;
  EXPECT_EQ(account_of(CheckpointPace(rule), 1, 0, 100).count, 100);
  rule = {};
  rule.every = 8;
  EXPECT_EQ(account_of(CheckpointPace(rule), 1000, 1, 100).count, 12);
  rule.seconds = 5000;  // whichever comes first
  EXPECT_EQ(account_of(CheckpointPace(rule), 1000, 1, 100).count, 12 + 12);
  rule.every = 0;
  EXPECT_EQ(account_of(CheckpointPace(rule), 1000, 1, 100).count, 0);
  EXPECT_FALSE(CheckpointPace(rule).writes_any());
}

TEST(CheckpointPace, KeepsToADiskThatBecomesSlow) {
  CheckpointPace pace({});
  pace.written(100, 0.01);
  EXPECT_TRUE(pace.is_due(10, 100.51));
  pace.written(102, 0.5);
  EXPECT_FALSE(pace.is_due(20, 126));
  EXPECT_TRUE(pace.is_due(21, 127.01));
  pace.written(130, 0.01);  // the longer of the last two counts
  EXPECT_FALSE(pace.is_due(30, 154));
  pace.written(156, 0.01);
  EXPECT_TRUE(pace.is_due(40, 156.6));
}

}  // namespace fsi::test
