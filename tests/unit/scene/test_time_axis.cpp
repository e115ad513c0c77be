#include "scene/time_axis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace fsi::test {

namespace {

Case in_time(double step, double end) {
  Case setup;
  setup.time = TimeData{};
  setup.time->step = step;
  setup.time->end = end;
  return setup;
}

Case at_rest(int load_steps) {
  Case setup;
  setup.static_load = StaticData{load_steps};
  return setup;
}

TEST(TimeAxis, HitsTheEndAndHasDecimalTimes) {
  const Case setup = in_time(0.1, 0.7);
  const TimeAxis axis(setup);
  EXPECT_EQ(axis.steps(), 7);
  EXPECT_EQ(axis.time_of(0), 0);
  EXPECT_EQ(axis.time_of(3), 0.3);  // 3 * 0.1 is not
  EXPECT_EQ(axis.time_of(7), 0.7);
}

TEST(TimeAxis, AWholeLoadIsOneWhereverItGoesOn) {
  const Case many = at_rest(400), few = at_rest(3);
  const TimeAxis before(many);
  for (int done = 1; done < 400; ++done) {  // the rest of the load added up in steps is not 1 from 4 or 5 on, say
    TimeAxis axis(few);
    axis.go_on(before.stretches(), done, before.time_of(done));
    EXPECT_EQ(axis.time_of(axis.steps()), 1) << done;
  }
}

TEST(TimeAxis, HalvesLoadStepsAndReturnsToTheirGrid) {
  const Case setup = at_rest(4);
  TimeAxis axis(setup);
  axis.halve(2);
  axis.halve(2);
  EXPECT_EQ(axis.steps(), 6);
  const double ends[] = {0, 0.25, 0.3125, 0.375, 0.5, 0.75, 1};
  for (int step = 0; step <= 6; ++step) EXPECT_EQ(axis.time_of(step), ends[step]) << step;
  axis.drop_insertions_after(2);  // the rest of the load step that is in progress
  EXPECT_EQ(axis.time_of(3), 0.5);
}

TEST(TimeAxis, GoesOnWithTheSameStepAsIfItHadNotStopped) {
  const Case setup = in_time(0.1, 0.7);
  TimeAxis axis(setup);
  const TimeAxis whole(setup);
  EXPECT_FALSE(axis.go_on(whole.stretches(), 3, 0.3));
  for (int step = 0; step <= 7; ++step) EXPECT_EQ(axis.time_of(step), whole.time_of(step));
  EXPECT_EQ(axis.stretches().size(), 1u);
}

TEST(TimeAxis, GoesOnWithAnotherStepAndKeepsWhatLiesBefore) {
  const Case before = in_time(0.1, 0.7), halved = in_time(0.05, 0.7), again = in_time(0.1, 1.0);
  TimeAxis axis(halved);
  EXPECT_TRUE(axis.go_on(TimeAxis(before).stretches(), 3, 0.3));
  EXPECT_EQ(axis.steps(), 3 + 8);
  const double times[] = {0, 0.1, 0.2, 0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65, 0.7};
  for (int step = 0; step <= 11; ++step) EXPECT_EQ(axis.time_of(step), times[step]) << step;

  TimeAxis third(again);
  EXPECT_TRUE(third.go_on(axis.stretches(), 5, 0.4));
  EXPECT_EQ(third.steps(), 5 + 6);
  EXPECT_EQ(third.time_of(2), 0.2);
  EXPECT_EQ(third.time_of(4), 0.35);
  EXPECT_EQ(third.time_of(6), 0.5);
  EXPECT_EQ(third.time_of(11), 1.0);
}

TEST(TimeAxis, CutsTheLastStepShortWhereTheNewOnesMissTheEnd) {
  const Case before = in_time(0.1, 1.0), other = in_time(0.25, 1.0);
  TimeAxis axis(other);
  EXPECT_TRUE(axis.go_on(TimeAxis(before).stretches(), 3, 0.3));
  EXPECT_EQ(axis.steps(), 3 + 3);
  EXPECT_EQ(axis.time_of(5), 0.8);
  EXPECT_EQ(axis.time_of(6), 1.0);
}

TEST(TimeAxis, GoesOnFromAnEndThatCutAStepShort) {
  const Case before = in_time(0.25, 0.9), longer = in_time(0.25, 1.4);
  const TimeAxis cut(before);
  EXPECT_EQ(cut.steps(), 4);
  EXPECT_EQ(cut.time_of(4), 0.9);
  TimeAxis axis(longer);
  EXPECT_FALSE(axis.go_on(cut.stretches(), 4, 0.9));
  EXPECT_EQ(axis.steps(), 4 + 2);
  EXPECT_EQ(axis.time_of(3), 0.75);
  EXPECT_EQ(axis.time_of(4), 0.9);
  EXPECT_EQ(axis.time_of(5), 1.15);
}

void expect_times(const TimeAxis& axis, const std::vector<double>& times) {
  EXPECT_EQ(axis.steps() + 1, static_cast<int>(times.size()));
  for (std::size_t step = 0; step < times.size(); ++step) EXPECT_EQ(axis.time_of(step), times[step]) << step;
  for (std::size_t step = 1; step < times.size(); ++step)
    EXPECT_NEAR(axis.length_of(step), times[step] - times[step - 1], 1e-12) << step;
}

// None of them a sliver: 100.01 ms in steps of 1 ms end with two of 0.505 ms.
TEST(TimeAxis, AnEndBetweenStepsIsHitByShorterOnes) {
  const Case near = in_time(0.25, 0.85), far = in_time(0.25, 0.9), sliver = in_time(1, 100.01),
             single = in_time(0.5, 0.7), whole = in_time(0.1, 0.7);
  expect_times(TimeAxis(near), {0, 0.25, 0.5, 0.675, 0.85});
  EXPECT_DOUBLE_EQ(TimeAxis(near).shorter_last_steps(), 0.175);
  expect_times(TimeAxis(far), {0, 0.25, 0.5, 0.75, 0.9});
  EXPECT_DOUBLE_EQ(TimeAxis(far).shorter_last_steps(), 0.15);
  const TimeAxis axis(sliver);
  EXPECT_EQ(axis.steps(), 101);
  EXPECT_EQ(axis.time_of(99), 99);
  EXPECT_EQ(axis.time_of(100), 99.505);
  EXPECT_EQ(axis.time_of(101), 100.01);
  EXPECT_NEAR(axis.shorter_last_steps(), 0.505, 1e-12);
  expect_times(TimeAxis(single), {0, 0.35, 0.7});
  EXPECT_EQ(TimeAxis(whole).shorter_last_steps(), 0);
}

TEST(TimeAxis, ShorterLastStepsComeAfterTheLastJump) {
  Case setup = in_time(0.25, 1.4);
  setup.inlet = PressureTable{{{0, 1}, {0.3, 1}, {0.3, 0}}};
  const TimeAxis axis(setup);
  expect_times(axis, {0, 0.15, 0.3, 0.55, 0.8, 1.05, 1.225, 1.4});
  EXPECT_TRUE(axis.jumps_at(0.3));
  setup.inlet = PressureTable{{{0, 1}, {1.2, 1}, {1.2, 0}}};
  expect_times(TimeAxis(setup), {0, 0.24, 0.48, 0.72, 0.96, 1.2, 1.4});
  EXPECT_DOUBLE_EQ(TimeAxis(setup).shorter_last_steps(), 0.2);
}

TEST(TimeAxis, GoesOnFromAnEndBetweenSteps) {
  const Case before = in_time(0.25, 0.85), longer = in_time(0.25, 1.35);
  const TimeAxis cut(before);
  TimeAxis axis(longer);
  EXPECT_FALSE(axis.go_on(cut.stretches(), 4, 0.85, cut.insertions()));
  expect_times(axis, {0, 0.25, 0.5, 0.675, 0.85, 1.1, 1.35});
  TimeAxis again(before);
  EXPECT_FALSE(again.go_on(cut.stretches(), 4, 0.85, cut.insertions()));
  expect_times(again, {0, 0.25, 0.5, 0.675, 0.85});
}

// Stopped before its end, and between the two steps that share what is left.
TEST(TimeAxis, GoesOnBeforeItsShorterLastSteps) {
  const Case setup = in_time(0.25, 0.85), longer = in_time(0.25, 1.1), whole = in_time(0.25, 1);
  const TimeAxis first(setup);
  for (const int last : {1, 2, 3}) {
    TimeAxis same(setup), later(longer), off(whole);
    EXPECT_FALSE(same.go_on(first.stretches(), last, first.time_of(last), first.insertions()));
    expect_times(same, {0, 0.25, 0.5, 0.675, 0.85});
    EXPECT_FALSE(later.go_on(first.stretches(), last, first.time_of(last), first.insertions()));
    EXPECT_FALSE(off.go_on(first.stretches(), last, first.time_of(last), first.insertions()));
    if (last < 3) {
      expect_times(later, {0, 0.25, 0.5, 0.75, 0.925, 1.1});
      expect_times(off, {0, 0.25, 0.5, 0.75, 1});
    } else {  // back to the grid
      expect_times(later, {0, 0.25, 0.5, 0.675, 0.75, 0.925, 1.1});
      expect_times(off, {0, 0.25, 0.5, 0.675, 0.75, 1});
    }
  }
}

TEST(TimeAxis, HalvesOneOfItsShorterLastSteps) {
  const Case setup = in_time(0.25, 0.85);
  TimeAxis axis(setup);
  axis.halve(3);
  expect_times(axis, {0, 0.25, 0.5, 0.5875, 0.675, 0.85});
  TimeAxis restarted(setup);  // between the halves
  EXPECT_FALSE(restarted.go_on(axis.stretches(), 3, 0.5875, axis.insertions()));
  expect_times(restarted, {0, 0.25, 0.5, 0.5875, 0.675, 0.85});
  TimeAxis early(setup);
  early.halve(1);
  expect_times(early, {0, 0.125, 0.25, 0.5, 0.675, 0.85});
  TimeAxis gone_on(setup);
  EXPECT_FALSE(gone_on.go_on(early.stretches(), 1, 0.125, early.insertions()));
  expect_times(gone_on, {0, 0.125, 0.25, 0.5, 0.675, 0.85});
  early.drop_insertions_after(0);
  EXPECT_EQ(early.steps(), 3);
}

TEST(TimeAxis, StepsEndAtNamedTimes) {
  Case setup = in_time(0.25, 1.5);
  setup.output.times = {0.3, 1.0, 1.5};
  expect_times(TimeAxis(setup), {0, 0.15, 0.3, 0.533333333333, 0.766666666667, 1, 1.25, 1.5});
  EXPECT_TRUE(output_times(setup).empty());  // entries are counted in steps, those of these times besides
  setup.output.interval = 0.5;
  EXPECT_EQ(output_times(setup), (std::vector<double>{0, 0.3, 0.5, 1, 1.5}));
  setup.time->adaptive = true;
  setup.output.interval.reset();
  setup.output.times = {0.3};
  setup.output.every = 0;
  setup.time->step = 0;
  TimeAxis axis(setup);
  EXPECT_EQ(axis.choose(1, 0, 0.2), 0.15);
  EXPECT_EQ(axis.choose(2, 0.15, 0.2), 0.15);
  EXPECT_EQ(axis.time_of(2), 0.3);
  EXPECT_FALSE(axis.jumps_at(0.3));
}

TEST(TimeAxis, SplitsTheRestOfAStaticLoadInEqualSteps) {
  const Case before = at_rest(4), finer = at_rest(9), coarser = at_rest(1);
  TimeAxis axis(finer);
  EXPECT_TRUE(axis.go_on(TimeAxis(before).stretches(), 3, 0.75));
  EXPECT_EQ(axis.steps(), 3 + 3);  // a quarter of nine, rounded up
  EXPECT_EQ(axis.time_of(2), 0.5);
  EXPECT_DOUBLE_EQ(axis.time_of(4), 0.75 + 0.25 / 3);
  EXPECT_EQ(axis.time_of(6), 1.0);

  TimeAxis last(coarser);
  EXPECT_TRUE(last.go_on(axis.stretches(), 4, axis.time_of(4)));
  EXPECT_EQ(last.steps(), 5);
  EXPECT_EQ(last.time_of(5), 1.0);
  EXPECT_DOUBLE_EQ(last.time_of(4), axis.time_of(4));
}

TEST(TimeAxis, HalvesAFailedStepAndReturnsToItsGrid) {
  const Case setup = in_time(0.5, 2);
  TimeAxis axis(setup);
  axis.halve(2);  // 0.5 to 1
  axis.halve(3);  // 0.75 to 1, once the first half is done
  EXPECT_EQ(axis.steps(), 6);
  const double times[] = {0, 0.5, 0.75, 0.875, 1, 1.5, 2};
  for (int step = 0; step <= 6; ++step) EXPECT_EQ(axis.time_of(step), times[step]) << step;
  for (int step = 1; step <= 6; ++step) EXPECT_EQ(axis.length_of(step), times[step] - times[step - 1]) << step;
  EXPECT_EQ(axis.planned_steps(), 4);
  EXPECT_EQ(axis.planned_time_of(3), 1.5);

  TimeAxis restarted(setup);  // between the halves
  EXPECT_FALSE(restarted.go_on(axis.stretches(), 3, 0.875, axis.insertions()));
  for (int step = 0; step <= 6; ++step) EXPECT_EQ(restarted.time_of(step), times[step]) << step;

  const Case finer = in_time(0.25, 2);
  TimeAxis changed(finer);
  EXPECT_TRUE(changed.go_on(axis.stretches(), 2, 0.75, axis.insertions()));
  const double finer_times[] = {0, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2};
  EXPECT_EQ(changed.steps(), 7);
  for (int step = 0; step <= 7; ++step) EXPECT_EQ(changed.time_of(step), finer_times[step]) << step;
}

TEST(TimeAxis, HalvesTheFirstHalfAgain) {
  const Case setup = in_time(0.5, 1);
  TimeAxis axis(setup);
  axis.halve(1);
  axis.halve(1);
  EXPECT_EQ(axis.steps(), 4);
  const double times[] = {0, 0.125, 0.25, 0.5, 1};
  for (int step = 0; step <= 4; ++step) EXPECT_EQ(axis.time_of(step), times[step]) << step;
  axis.drop_insertions_after(0);
  EXPECT_EQ(axis.steps(), 2);
}

TEST(TimeAxis, StepsEndAtTimesOfOutput) {
  Case setup = in_time(0.3, 1.2);
  setup.output.interval = 0.5;
  const TimeAxis axis(setup);
  const double times[] = {0, 0.25, 0.5, 0.75, 1, 1.2};
  EXPECT_EQ(axis.steps(), 5);
  for (int step = 0; step <= 5; ++step) EXPECT_EQ(axis.time_of(step), times[step]) << step;
  EXPECT_EQ(axis.length_of(2), 0.25);
  EXPECT_FALSE(axis.jumps_at(0.5));
}

/// The artery's pulse.
Case adaptive(double end) {
  Case setup = in_time(0, end);
  setup.time->adaptive = true;
  setup.output.every = 0;
  setup.inlet = PressureTable{{{0, 1}, {0.125, 1}, {0.125, 0}}};
  return setup;
}

TEST(TimeAxis, AdaptiveStepsAreEqualUpToTheNextStop) {
  const Case setup = adaptive(1);
  TimeAxis axis(setup);
  EXPECT_EQ(axis.choose(1, 0, 0.1), 0.0625);
  EXPECT_EQ(axis.choose(1, 0, 0.05), 0.125 / 3);  // rejected
  EXPECT_EQ(axis.choose(2, axis.time_of(1), 0.05), 0.125 / 3);
  EXPECT_EQ(axis.choose(3, axis.time_of(2), 0.05), 0.125 / 3);
  EXPECT_EQ(axis.time_of(3), 0.125);
  EXPECT_TRUE(axis.jumps_at(axis.time_of(3)));
  EXPECT_EQ(axis.choose(4, 0.125, 0.5), 0.4375);
  EXPECT_EQ(axis.steps(), 5);
  EXPECT_EQ(axis.choose(5, axis.time_of(4), 0.5), 0.4375);
  EXPECT_EQ(axis.time_of(5), 1);
  EXPECT_EQ(axis.steps(), 5);
}

/// Steps of a plan as they follow from one stop to the next.
int steps_between(const std::vector<double>& stops, double start, double longest) {
  int steps = 0;
  for (const double stop : stops)
    if (stop > start) {
      steps += static_cast<int>(std::ceil((stop - start) / longest - 1e-9));
      start = stop;
    }
  return steps;
}

TEST(TimeAxis, EstimatesAdaptiveStepsToTheTimesOfOutputAndJumpsThatAreLeft) {
  Case setup = adaptive(3);
  setup.output.interval = 0.25;
  std::vector<double> stops{0.125};  // the jump
  for (int k = 1; k <= 12; ++k) stops.push_back(0.25 * k);
  TimeAxis axis(setup);
  double time = 0;
  int step = 0;
  for (const double longest : {0.1, 0.04, 0.3, 0.2, 0.06, 0.06, 0.5, 0.11, 0.02, 0.02}) {
    const double length = axis.choose(++step, time, longest);
    time = axis.time_of(step);
    EXPECT_EQ(axis.steps(), step + steps_between(stops, time, length)) << step;
  }
}

TEST(TimeAxis, TimesOfManyStopsAreThoseOfTheirIntervals) {
  Case setup = in_time(0.3, 1000);
  setup.output.interval = 0.5;
  setup.inlet = PressureTable{{{0, 1}, {100.2, 1}, {100.2, 0}}};
  const TimeAxis axis(setup);
  EXPECT_EQ(axis.steps(), 4000);  // two in an interval; the jump cuts one in two of one step each
  EXPECT_EQ(axis.time_of(400), 100);
  EXPECT_EQ(axis.time_of(401), 100.2);
  EXPECT_EQ(axis.time_of(402), 100.5);
  EXPECT_EQ(axis.time_of(3997), 999.25);
  EXPECT_EQ(axis.time_of(3999), 999.8);  // up to the end as long as asked
  EXPECT_TRUE(axis.jumps_at(100.2));
  EXPECT_FALSE(axis.jumps_at(100.5));
  EXPECT_EQ(axis.next_stop(100), 100.2);
  EXPECT_EQ(axis.next_stop(999.5), 1000);
}

TEST(TimeAxis, GoesOnFromEqualStepsToAdaptiveOnesAndBack) {
  Case equal = in_time(0.25, 2);
  const Case chosen = adaptive(2);
  equal.inlet = chosen.inlet;
  const TimeAxis before(equal);
  TimeAxis axis(chosen);
  EXPECT_TRUE(axis.go_on(before.stretches(), 2, 0.375));
  axis.choose(3, 0.375, 0.5);  // 1.625 in four steps
  EXPECT_EQ(axis.time_of(1), 0.125);
  EXPECT_EQ(axis.time_of(2), 0.375);
  EXPECT_EQ(axis.time_of(3), 0.78125);
  TimeAxis again(chosen);
  EXPECT_FALSE(again.go_on(axis.stretches(), 3, 0.78125, axis.insertions()));
  EXPECT_EQ(again.choose(4, 0.78125, 0.5), 0.40625);
  TimeAxis back(equal);
  EXPECT_TRUE(back.go_on(axis.stretches(), 3, 0.78125, axis.insertions()));
  EXPECT_EQ(back.steps(), 3 + 5);
  const double times[] = {0, 0.125, 0.375, 0.78125, 1.03125, 1.28125, 1.53125, 1.78125, 2};
  for (int step = 0; step <= 8; ++step) EXPECT_EQ(back.time_of(step), times[step]) << step;
}

}  // namespace

}  // namespace fsi::test
