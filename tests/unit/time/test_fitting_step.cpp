#include <gtest/gtest.h>

#include "time/fitting_step.hpp"

namespace fsi {
namespace {

TEST(FittingStep, IsNoLongerAndOfFewDigits) {
  EXPECT_DOUBLE_EQ(fitting_step(800, 3), 2.5) << "320 a period; 267 would be 2.99625468...";
  EXPECT_DOUBLE_EQ(fitting_step(12, 0.7), 0.6);
  EXPECT_DOUBLE_EQ(fitting_step(800, 2), 2) << "fits already";
  EXPECT_DOUBLE_EQ(fitting_step(7, 3.6), 3.5);
}

TEST(FittingStep, DividesThePeriodWhereNoneHasFewDigits) {
  const double period = 0.7391827465, step = fitting_step(period, 0.1);
  EXPECT_DOUBLE_EQ(step, period / 8);
}

}  // namespace
}  // namespace fsi
