#include "time/step_size_controller.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace fsi::test {

namespace {

/// Marches with steps whose error is (length / right)^order times the allowed one.
struct March {
  StepSizeController controller;
  int order;
  int steps = 0, rejected = 0, changes = 0;

  March(const StepLimits& limits, int order_) : controller(limits, order_), order(order_) {}

  void step(double right) {
    double length = controller.wanted();
    while (std::pow(length / right, order) > 1) {
      ASSERT_TRUE(controller.reject(length, std::pow(length / right, order)));
      ++rejected;
      length = controller.wanted();
    }
    controller.accept(length, std::pow(length / right, order));
    ++steps;
    if (controller.wanted() != length) ++changes;
  }
};

TEST(StepSizeController, FindsTheLengthOfTheToleranceAndKeepsIt) {
  for (const int order : {1, 2}) {
    March march({0.01, 1e-6, 10}, order);
    for (int i = 0; i < 100; ++i) march.step(1);
    EXPECT_GT(march.controller.wanted(), 0.5);
    EXPECT_LE(march.controller.wanted(), 1);
    EXPECT_EQ(march.rejected, 0);
    EXPECT_LE(march.changes, 12);  // growth by two or less each, from a hundredth
  }
}

TEST(StepSizeController, DoesNotChangeForSmallGains) {
  March march({1, 1e-6, 10}, 2);
  for (int i = 0; i < 50; ++i) march.step(1.15 + 0.05 * std::sin(i));
  EXPECT_EQ(march.changes, 0);
  EXPECT_EQ(march.controller.wanted(), 1);
}

TEST(StepSizeController, GrowsByTwoAtMostAndShrinksByFiveAtMost) {
  StepSizeController controller({1, 1e-6, 100}, 2);
  controller.accept(1, 1e-8);
  EXPECT_EQ(controller.wanted(), 2);
  EXPECT_TRUE(controller.reject(2, 1e8));
  EXPECT_GT(controller.wanted(), 0.3);
  EXPECT_LE(controller.wanted(), 0.4);
}

TEST(StepSizeController, DoesNotGrowInTheStepAfterARejectedOne) {
  StepSizeController controller({1, 1e-6, 100}, 2);
  EXPECT_TRUE(controller.reject(1, 4));
  const double wanted = controller.wanted();
  EXPECT_LT(wanted, 0.5);
  controller.accept(wanted, 0.01);
  EXPECT_EQ(controller.wanted(), wanted);
  controller.accept(wanted, 0.01);
  EXPECT_GT(controller.wanted(), wanted);
}

TEST(StepSizeController, KeepsItsLimits) {
  StepSizeController controller({1, 0.5, 2}, 2);
  controller.accept(1, 0);
  controller.accept(2, 0);
  EXPECT_EQ(controller.wanted(), 2);
  EXPECT_TRUE(controller.reject(2, 100));
  EXPECT_EQ(controller.wanted(), 0.5);
  EXPECT_FALSE(controller.reject(0.5, 10));
}

TEST(StepSizeController, GoesBelowTheSmallestForAStepWithoutSolutionAlone) {
  StepSizeController controller({1, 0.5, 2}, 2);
  controller.fail(0.5);
  EXPECT_EQ(controller.wanted(), 0.125);
  controller.accept(0.125);
  controller.accept(0.125, 0.1);
  EXPECT_EQ(controller.wanted(), 0.5);
}

TEST(StepSizeController, BeginsAnewAfterAJump) {
  StepSizeController controller({0.1, 1e-3, 2}, 2);
  for (int i = 0; i < 5; ++i) controller.accept(controller.wanted(), 1e-6);
  EXPECT_GT(controller.wanted(), 1);
  controller.restart();
  EXPECT_EQ(controller.wanted(), 0.1);
}

TEST(StepSizeController, AStepCutShortSaysNothingAboutTheLengthWanted) {
  StepSizeController controller({1, 1e-3, 2}, 2);
  controller.accept(0.1, 0.25 * 0.01);
  EXPECT_EQ(controller.wanted(), 1);
}

TEST(StepSizeController, GoesOnFromItsMemory) {
  StepSizeController whole({0.1, 1e-3, 2}, 2), again = whole;
  whole.accept(0.1, 0.02);
  WrittenArchive archive = archive_of(whole);
  again.keep(archive.turn());
  for (const double error : {0.7, 0.3, 0.05}) {
    whole.accept(whole.wanted(), error);
    again.accept(again.wanted(), error);
    EXPECT_EQ(whole.wanted(), again.wanted());
  }
}

}  // namespace

}  // namespace fsi::test
