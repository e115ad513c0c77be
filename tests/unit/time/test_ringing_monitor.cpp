#include "diagnostics/ringing_monitor.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace fsi::test {

namespace {

/// Steps until the monitor says something; 0: it does not. Pressures at three places, a wave of period 4 and a sawtooth
/// of `share` of it that falls by `decay` in each step of length 0.1.
int named_after(double share, double decay, int steps = 60) {
  RingingMonitor monitor(1.0);
  for (int step = 1; step <= steps; ++step) {
    std::vector<double> p;
    for (int place = 0; place < 3; ++place)
      p.push_back(std::sin(0.1 * step * 2 * M_PI / 4 + place) +
                  share * (place + 1) / 3 * std::pow(decay, step) * (step % 2 == 0 ? 1 : -1));
    if (const auto amplitude = monitor.look(0.1 * step, p)) {
      EXPECT_NEAR(*amplitude, share * std::pow(decay, step - 1), 0.25 * share);
      return step;
    }
  }
  return 0;
}

TEST(RingingMonitor, NamesASawtoothAfterEightSteps) {
  EXPECT_GE(named_after(0.3, 1), 8);
  EXPECT_LE(named_after(0.3, 1), 12);
  EXPECT_GT(named_after(0.3, 1.05), 0);
}

TEST(RingingMonitor, LetsPassWhatIsSmooth) {
  EXPECT_EQ(named_after(0, 1), 0);
}

TEST(RingingMonitor, LetsPassWhatIsSmall) {
  EXPECT_EQ(named_after(0.02, 1), 0);
}

TEST(RingingMonitor, LetsPassWhatDiesAway) {
  EXPECT_EQ(named_after(0.3, 0.85), 0);
}

}  // namespace

}  // namespace fsi::test
