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

TEST(PressureTable, SinglePointIsAConstant) {
  const PressureTable constant{{{0.5, 2}}};
  EXPECT_DOUBLE_EQ(constant.mean(0, 1), 2);
  EXPECT_DOUBLE_EQ(constant.mean(3, 4), 2);
  EXPECT_DOUBLE_EQ(PressureTable{}.mean(0, 1), 0);
}

}  // namespace

}  // namespace fsi::test
