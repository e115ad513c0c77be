// The walk to a step through shorter ones: it arrives where each solution lies near the last ones, and says where solutions end.
#include "system/step_continuation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace fsi::test {

namespace {

Solution of_number(double x) {
  Solution solution;
  solution.wall = {x};
  return solution;
}

/// Finds a solution that lies near enough to the start only, as Newton's method does.
bool find(Solution& now, double solution, double reach) {
  if (!(std::abs(now.wall[0] - solution) <= reach)) return false;
  now.wall[0] = solution;
  return true;
}

TEST(StepContinuation, ArrivesWhereTheWholeStepIsOutOfReach) {
  Solution now = of_number(0);
  const auto at = [](double share) { return std::expm1(3 * share); };  // 19 at the end
  ASSERT_FALSE(find(now, at(1), 0.5));
  const StepWalk walk = walk_to_step(now, [&](double share) { return find(now, at(share), 0.5); });
  EXPECT_TRUE(walk.arrived());
  EXPECT_EQ(walk.failed, 0);
  EXPECT_EQ(now.wall[0], at(1));
  EXPECT_GT(walk.lengths_tried, 5);
}

TEST(StepContinuation, StartsAreExtrapolated) {
  Solution now = of_number(1);
  const auto at = [](double share) { return 1 + 100 * share; };
  int far = 0;
  const StepWalk walk = walk_to_step(now, [&](double share) {
    if (!(std::abs(now.wall[0] - at(share)) < 1e-9)) ++far;
    now.wall[0] = at(share);
    return true;
  });
  EXPECT_TRUE(walk.arrived());
  EXPECT_EQ(far, 1) << "the first alone has nothing to be extrapolated from";
}

TEST(StepContinuation, SaysWhereSolutionsTurnBack) {
  constexpr double end = 0.61;  // x^2 = 1 - share / end: no solution beyond
  Solution now = of_number(1);
  const StepWalk walk =
      walk_to_step(now, [&](double share) { return share <= end && find(now, std::sqrt(1 - share / end), 0.4); });
  EXPECT_FALSE(walk.arrived());
  EXPECT_LE(walk.solved, end);
  EXPECT_GT(walk.failed, end);
  EXPECT_LT(walk.failed - walk.solved, 0.06);
  EXPECT_EQ(now.wall[0], std::sqrt(1 - walk.solved / end)) << "the last solution is what is left";
}

TEST(StepContinuation, WhereNothingIsSolvedTheStateIsAsItWas) {
  Solution now = of_number(7);
  const StepWalk walk = walk_to_step(now, [&](double) {
    now.wall[0] = std::nan("");
    return false;
  });
  EXPECT_EQ(walk.solved, 0);
  EXPECT_GT(walk.failed, 0);
  EXPECT_EQ(now.wall[0], 7);
}

}  // namespace

}  // namespace fsi::test
