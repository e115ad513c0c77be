#include "driver/state_checkpoint.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/error.hpp"

namespace fsi::test {

namespace {

constexpr std::size_t interface_values = 6;
const std::filesystem::path file = "run/checkpoint.h5";

Case adaptive_case() {
  Case setup;
  setup.time.emplace();
  setup.time->adaptive = true;
  setup.time->end = 10;
  return setup;
}

/// A state of the sizes of some scene, of a scheme with balances.
State at_rest() {
  State state;
  state.now = {std::vector<double>(6, 0.0), std::vector<double>(8, 0.0), std::vector<double>(12, 0.0)};
  state.before = {state.now, state.now, state.now};
  state.balances = state.before;
  state.wall_velocity = state.wall_acceleration = state.wall_velocity_before = std::vector<double>(9, 0.0);
  return state;
}

const std::vector<double> ends{0.5, 1, 1.25, 1.5};  // of four adaptive steps

State after_four_steps() {
  State state = at_rest();
  double next = 1;
  for (auto& level : state.before)
    for (auto* field : {&level.mesh, &level.fluid, &level.wall})
      for (double& number : *field) number = next++;
  state.balances = state.before;
  state.now = state.before[0];
  state.step = 4;
  state.time = 1.5;
  state.times = {1.5, 1.25, 1};
  state.balance_times = {1.4, 1.2, 0.8};
  state.since_jump = 3;
  state.balances_since_jump = 4;
  return state;
}

Memory some_memory() {
  Memory memory;
  for (const char* part : {"mesh", "mesh_reference"})
    memory.arrays[std::string("kept.") + part] = std::vector<double>(6, 1);
  for (const char* part : {"flow", "flow_reference"})
    memory.arrays[std::string("kept.") + part] = std::vector<double>(8, 1);
  memory.arrays["kept.wall"] = std::vector<double>(12, 1);
  for (const char* part : {"step", "period", "flow_factor", "acceleration_factor", "wall_pressure"})
    memory.numbers[std::string("kept.") + part] = 0.5;
  memory.numbers["alternating_steps"] = 2;
  for (const char* load : {"load0", "load1", "load2"}) memory.arrays[load] = std::vector<double>(interface_values, 3);
  memory.arrays["iqn_ils.v"] = memory.arrays["iqn_ils.w"] = std::vector<double>(2 * interface_values, 4);
  memory.arrays["iqn_ils.age"] = {0, 1};
  memory.arrays["iqn_ils.before.a"] = memory.arrays["iqn_ils.before.b"] = std::vector<double>(interface_values, 5);
  memory.numbers["iqn_ils.before.rank"] = 1;
  memory.numbers["iqn_ils.before.age"] = 7;
  return memory;
}

Checkpoint example() {
  const Case setup = adaptive_case();
  TimeAxis axis(setup);
  double start = 0;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    std::vector<Insertion> inserted = axis.insertions();
    inserted.push_back({static_cast<int>(k) + 1, ends[k], ends[k] - start});
    axis.go_on({{0, ends[k], 0}}, static_cast<int>(k) + 1, ends[k], inserted);
    start = ends[k];
  }
  Checkpoint checkpoint;
  store(after_four_steps(), some_memory(), axis, checkpoint);
  checkpoint.arrays["march.controller"] = {1, 2, 3};
  checkpoint.arrays["march.estimate"] = {1, 2, 3, 4};
  store(TableDigests{{"flow.csv", {100, 1, 2}}}, checkpoint);
  return checkpoint;
}

/// What is said of a changed checkpoint; empty: nothing.
std::string said_of(const std::function<void(Checkpoint&)>& change) {
  Checkpoint checkpoint = example();
  change(checkpoint);
  State state = at_rest();
  try {
    restore(file, checkpoint, interface_values, state);
    stored_steps(file, checkpoint, state, ends);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(StateCheckpoint, ComesBackAsItWas) {
  State state = at_rest();
  const Checkpoint checkpoint = example();
  const Memory memory = restore(file, checkpoint, interface_values, state);
  const State before = after_four_steps();
  EXPECT_EQ(state.step, 4);
  EXPECT_EQ(state.time, 1.5);
  EXPECT_EQ(state.times, before.times);
  EXPECT_EQ(state.balance_times, before.balance_times);
  EXPECT_EQ(state.before[2].wall, before.before[2].wall);
  EXPECT_EQ(state.balances_since_jump, 4);
  EXPECT_EQ(memory.arrays, some_memory().arrays);
  EXPECT_EQ(memory.numbers, some_memory().numbers);
  EXPECT_EQ(stored_digests(checkpoint), (TableDigests{{"flow.csv", {100, 1, 2}}}));
  const StoredSteps steps = stored_steps(file, checkpoint, state, ends);
  ASSERT_EQ(steps.insertions.size(), ends.size());
  for (std::size_t k = 0; k < ends.size(); ++k) {
    EXPECT_EQ(steps.insertions[k].step, static_cast<int>(k) + 1);
    EXPECT_EQ(steps.insertions[k].end, ends[k]);
  }
}

TEST(StateCheckpoint, HasArraysOfKnownKindsOnly) {
  Checkpoint checkpoint = example();
  for (const auto& [name, kind] : {std::pair{"level2.mesh", ArrayKind::mesh},
                                   {"balance1.flow", ArrayKind::flow},
                                   {"rate.wall", ArrayKind::wall},
                                   {"wall_velocity_before", ArrayKind::wall_vectors},
                                   {"rate.wall_velocity", ArrayKind::wall_vectors},
                                   {"level0.windkessel", ArrayKind::alike},
                                   {"stepper.wall.flow_reference", ArrayKind::flow},
                                   {"stepper.kept.support_loads", ArrayKind::alike},
                                   {"stepper.load1", ArrayKind::interface},
                                   {"stepper.iqn_ils.before.a", ArrayKind::interface_columns},
                                   {"stepper.iqn_ils.age", ArrayKind::alike},
                                   {"table.flow.csv", ArrayKind::alike},
                                   {"statistics.now", ArrayKind::shear_vectors},
                                   {"statistics.mean", ArrayKind::shear_scalars}}) {
    EXPECT_EQ(kind_of_array(name), kind) << name;
    checkpoint.arrays[name];
  }
  EXPECT_NO_THROW(require_kinds(checkpoint));
  for (const char* unknown : {"stepper.load3", "stepper.kept.walls", "level0", "mesh", "statistics.wall", "march.v"}) {
    EXPECT_FALSE(kind_of_array(unknown)) << unknown;
    Checkpoint other = checkpoint;
    other.arrays[unknown];
    EXPECT_THROW(require_kinds(other), std::logic_error) << unknown;
  }
}

TEST(StateCheckpoint, DoesNotGrowWithTheNumberOfAdaptiveSteps) {
  EXPECT_EQ(example().arrays.at("inserted_steps"), (std::vector<double>{4, 1.5, 0.25}));
  EXPECT_EQ(example().integers.at("inserted_until"), 3);
}

TEST(StateCheckpoint, AfterAStepWithoutSolutionCanBeReadAgain) {
  const Case setup = adaptive_case();
  TimeAxis axis(setup);
  std::vector<Insertion> inserted;
  double start = 0;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    inserted.push_back({static_cast<int>(k) + 1, ends[k], ends[k] - start});
    start = ends[k];
  }
  axis.go_on({{0, start, 0}}, 4, start, inserted);
  axis.choose(5, start, 0.25);
  axis.drop_insertions_after(4);
  Checkpoint checkpoint;
  store(after_four_steps(), some_memory(), axis, checkpoint);
  State state = at_rest();
  restore(file, checkpoint, interface_values, state);
  EXPECT_NO_THROW(stored_steps(file, checkpoint, state, ends));
}

TEST(StateCheckpoint, WithANumberThatIsNotFiniteIsRefused) {
  const Checkpoint whole = example();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (const auto& [name, array] : whole.arrays)
      for (std::size_t i = 0; i < array.size(); ++i)
        EXPECT_NE(said_of([&](Checkpoint& c) { c.arrays[name][i] = bad; }), "") << name << i;
    for (const auto& [name, number] : whole.reals)
      EXPECT_NE(said_of([&](Checkpoint& c) { c.reals[name] = bad; }), "") << name;
    EXPECT_NE(said_of([&](Checkpoint& c) { c.time = bad; }), "");
  }
}

TEST(StateCheckpoint, WithAnArrayMissingTooLongOrUnknownIsRefused) {
  const Checkpoint whole = example();
  for (const auto& [name, array] : whole.arrays) {
    if (name.rfind("march.", 0) == 0 || name.rfind("table.", 0) == 0) continue;
    EXPECT_NE(said_of([&](Checkpoint& c) { c.arrays.erase(name); }), "") << name;
    EXPECT_NE(said_of([&](Checkpoint& c) { c.arrays[name].push_back(0); }), "") << name;
    if (!array.empty()) {
      EXPECT_NE(said_of([&](Checkpoint& c) { c.arrays[name].pop_back(); }), "") << name;
    }
  }
  EXPECT_NE(said_of([](Checkpoint& c) { c.arrays["more"] = {1}; }).find("more: is unknown"), std::string::npos);
  EXPECT_NE(said_of([](Checkpoint& c) { c.arrays["stepper.more"] = {1}; }), "");
  EXPECT_NE(said_of([](Checkpoint& c) { c.arrays["march.more"] = {1}; }), "");
  EXPECT_NE(said_of([](Checkpoint& c) { c.arrays["march.controller"] = {1}; }), "");
  for (const char* name : {"stepper.kept.step", "stepper.kept.period", "stepper.iqn_ils.before.rank"})
    EXPECT_NE(said_of([&](Checkpoint& c) { c.reals.erase(name); }), "") << name;
}

TEST(StateCheckpoint, WithAStepOrACountOutOfRangeIsRefused) {
  for (const std::int64_t step :
       {std::int64_t{-1}, std::int64_t{0}, std::int64_t{3}, std::int64_t{5}, std::int64_t{1} << 31,
        std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min()}) {
    if (step == 5) continue;  // iterations.csv then lacks a row, which EarlierTables sees
    EXPECT_NE(said_of([&](Checkpoint& c) { c.step = step; }), "") << step;
  }
  for (const double count : {-1.0, 0.5, 5.0, 1e300}) {
    EXPECT_NE(said_of([&](Checkpoint& c) { c.arrays["since_jump"][0] = count; }), "") << count;
    EXPECT_NE(said_of([&](Checkpoint& c) { c.arrays["since_jump"][1] = 2 * count; }), "") << count;
  }
  for (const double count : {-1.0, 0.5, 2.0, 1e300})
    EXPECT_NE(said_of([&](Checkpoint& c) { c.reals["stepper.iqn_ils.before.rank"] = count; }), "") << count;
  EXPECT_NE(said_of([](Checkpoint& c) { c.arrays["stepper.iqn_ils.age"][0] = 1e300; }), "");
  for (const std::int64_t until : {-1, 5})
    EXPECT_NE(said_of([&](Checkpoint& c) { c.integers["inserted_until"] = until; }), "");
}

TEST(StateCheckpoint, WithTimesOutOfOrderIsRefused) {
  for (const char* name : {"level_times", "balance_times"})
    for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 2)})
      EXPECT_NE(said_of([&, a = a, b = b](Checkpoint& c) { std::swap(c.arrays[name][a], c.arrays[name][b]); }), "")
          << name;
  EXPECT_NE(said_of([](Checkpoint& c) { c.time = -1.5; }), "");
  EXPECT_NE(said_of([](Checkpoint& c) { c.arrays["level_times"][1] = 1.26; }).find("iterations.csv"),
            std::string::npos);
  EXPECT_NE(said_of([](Checkpoint& c) { c.arrays["balance_times"][0] = 1.6; }), "");
  for (const auto& [place, value] : {std::pair(0, 1.0), std::pair(0, -1.0), std::pair(0, 0.5), std::pair(1, 2.0),
                                     std::pair(1, -1.0), std::pair(2, -1.0)})
    EXPECT_NE(said_of([place = place, value = value](Checkpoint& c) { c.arrays["step_lengths"][place] = value; }), "")
        << place;
  for (const auto& [place, value] :
       {std::pair(0, 3.0), std::pair(0, 0.0), std::pair(0, 1e300), std::pair(1, 1.4), std::pair(2, 0.0)})
    EXPECT_NE(said_of([place = place, value = value](Checkpoint& c) { c.arrays["inserted_steps"][place] = value; }), "")
        << place;
}

TEST(StateCheckpoint, BehindTheEndOfTheRunIsRefused) {
  const State state = after_four_steps();
  EXPECT_NO_THROW(require_not_beyond(file, state, 1.5));
  EXPECT_THROW(require_not_beyond(file, state, 1.25), InputError);
}

}  // namespace

}  // namespace fsi::test
