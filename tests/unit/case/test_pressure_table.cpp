#include <gtest/gtest.h>

#include "case/case.hpp"

namespace fsi::test {

namespace {

TEST(PressureTable, PulseKeepsItsImpulseForEveryStep) {
  const PressureTable pulse{{{0, 1.332}, {0.125, 1.332}, {0.125, 0}}};
  for (const double step : {0.05, 0.0625, 0.125, 0.25, 1.0}) {
    double impulse = 0;
    for (int i = 0; i < 40; ++i) impulse += step * pulse.mean(i * step, (i + 1) * step);
    EXPECT_NEAR(impulse, 1.332 * 0.125, 1e-15) << step;
  }
  EXPECT_DOUBLE_EQ(pulse.mean(0, 0.125), 1.332);
  EXPECT_DOUBLE_EQ(pulse.mean(0.125, 0.25), 0);
  EXPECT_DOUBLE_EQ(pulse.mean(0.0625, 0.1875), 0.666);
  EXPECT_EQ(pulse.at_end(), 0);
}

TEST(PressureTable, IsLinearBetweenItsPointsAndConstantBeyond) {
  const PressureTable ramp{{{1, 0}, {3, 4}}};
  EXPECT_DOUBLE_EQ(ramp.mean(1, 3), 2);
  EXPECT_DOUBLE_EQ(ramp.mean(1, 2), 1);
  EXPECT_DOUBLE_EQ(ramp.mean(0, 1), 0);
  EXPECT_DOUBLE_EQ(ramp.mean(3, 5), 4);
  EXPECT_DOUBLE_EQ(ramp.mean(0, 4), (0 + 4 + 4) / 4.0);
  EXPECT_EQ(ramp.at_end(), 4);
}

TEST(PressureTable, JumpsInTheMiddleOfAStep) {
  const PressureTable jump{{{0, 1}, {1, 1}, {1, 5}, {2, 5}}};
  EXPECT_DOUBLE_EQ(jump.mean(0.5, 1.5), 3);
  EXPECT_DOUBLE_EQ(jump.mean(0.75, 1.75), (0.25 * 1 + 0.75 * 5));
}

// A step looks at the points around it only; those far away change no bit.
TEST(PressureTable, FarPointsChangeNothing) {
  PressureTable all;
  for (int i = 0; i < 1000; ++i) all.points.push_back({0.1 * i, -1.3 * (i % 7) + 0.01 * i});
  all.points.insert(all.points.begin() + 501, {50.0, 3});  // a jump
  for (const auto& [from, to] : {std::pair{49.93, 50.41}, {50.0, 50.1}, {50.02, 50.03}, {49.9, 50.0}, {49.0, 51.0}}) {
    PressureTable near;
    near.points.assign(all.points.begin() + 480, all.points.begin() + 520);
    EXPECT_EQ(all.mean(from, to), near.mean(from, to)) << from;
  }
  EXPECT_EQ(all.mean(200, 300), all.at_end());
  EXPECT_EQ(all.mean(-2, -1), all.points.front().second);
  EXPECT_GT(all.mean(-1, 200), 0);
}

TEST(PressureTable, SinglePointIsAConstant) {
  const PressureTable constant{{{0.5, 2}}};
  EXPECT_DOUBLE_EQ(constant.mean(0, 1), 2);
  EXPECT_DOUBLE_EQ(constant.mean(3, 4), 2);
  EXPECT_DOUBLE_EQ(PressureTable{}.mean(0, 1), 0);
}

TEST(PressureTable, RepeatsItselfExactly) {
  // Over a period of 4 ms: up to 2 in the first, down to -1 by a jump in its middle, there to the end, and back by a jump.
  const PressureTable beat{{{0, 0}, {2, 2}, {2, -1}, {4, -1}}, 4};
  EXPECT_DOUBLE_EQ(beat.mean(0, 4), 0);
  EXPECT_DOUBLE_EQ(beat.mean(0, 2), 1);
  EXPECT_DOUBLE_EQ(beat.mean(8, 10), 1);
  EXPECT_DOUBLE_EQ(beat.mean(9, 10), 1.5);
  EXPECT_DOUBLE_EQ(beat.mean(3, 5), (-1 + 0.5) / 2);
  EXPECT_DOUBLE_EQ(beat.mean(1, 4 * 25 + 1), 0) << "whole periods from anywhere";
  EXPECT_DOUBLE_EQ(beat.mean(3, 4 * 25 + 5), (-1 + 0.5) / 102);
  EXPECT_DOUBLE_EQ(beat.at(1), 1);
  EXPECT_DOUBLE_EQ(beat.at(401), 1);
  EXPECT_DOUBLE_EQ(beat.at(2), 2) << "the value before the jump";
  EXPECT_DOUBLE_EQ(beat.at(400), -1) << "alike at the end of a period";
  EXPECT_EQ(beat.jumps(9), (std::vector<double>{2, 4, 6, 8}));
  EXPECT_EQ(beat.jumps_in_period(), 2u);
  double impulse = 0;  // of steps that do not fit the period
  for (int k = 0; k < 1000; ++k) impulse += 0.37 * beat.mean(0.37 * k, 0.37 * (k + 1));
  EXPECT_NEAR(impulse, 370 * beat.mean(0, 370), 1e-9);
}

TEST(PressureTable, WithoutJumpsWhereAPeriodEndsAsItBegins) {
  const PressureTable beat{{{0, 1}, {1, 3}, {4, 1}}, 4};
  EXPECT_TRUE(beat.jumps(100).empty());
  EXPECT_DOUBLE_EQ(beat.mean(0, 40), 2);
  const PressureTable held{{{1, 1}, {2, 3}}, 4};  // before and after its points their values
  EXPECT_EQ(held.jumps(9), (std::vector<double>{4, 8}));
  EXPECT_DOUBLE_EQ(held.mean(0, 4), (1 + 2 + 2 * 3) / 4.0);
}

}  // namespace

}  // namespace fsi::test
