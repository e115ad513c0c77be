#include "base/profile.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace fsi::test {

namespace {

void wait(int milliseconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

// Sleeps last at least as long as asked, and on a busy machine longer: only what that leaves certain is checked.
TEST(Profile, APhaseDoesNotCountWhatWasEnteredInIt) {
  Profile profile;
  const auto begin = std::chrono::steady_clock::now();
  {
    const auto outer = profile.phase("outer");
    wait(5);
    for (int k = 0; k < 2; ++k) {
      const auto inner = profile.phase("inner");
      wait(20);
      const auto innermost = profile.phase("innermost");
      wait(10);
    }
  }
  const double all = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const auto& phases = profile.phases();
  EXPECT_GE(phases.at("outer").seconds, 0.005);
  EXPECT_GE(phases.at("inner").seconds, 0.040);
  EXPECT_GE(phases.at("innermost").seconds, 0.020);
  EXPECT_EQ(phases.at("inner").calls, 2);
  double sum = 0;
  for (const auto& [name, phase] : phases) sum += phase.seconds;
  EXPECT_LE(sum, all);  // counted twice, the inner phases would make it longer
}

}  // namespace

}  // namespace fsi::test
