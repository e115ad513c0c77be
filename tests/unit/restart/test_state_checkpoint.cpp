#include "restart/state_checkpoint.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <optional>
#include <string>
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

/// Sizes of the scene that these states are of.
std::optional<std::size_t> length(ArrayKind kind) {
  switch (kind) {
    case ArrayKind::mesh:
      return 6;
    case ArrayKind::flow:
      return 8;
    case ArrayKind::wall:
      return 12;
    case ArrayKind::wall_vectors:
      return 9;
    case ArrayKind::interface:
    case ArrayKind::interface_columns:
      return interface_values;
    case ArrayKind::opening_values:
      return 0;
    default:
      return {};
  }
}

/// What a stepper might keep.
struct Keeper {
  int age = 7;
  double factor = 0.5;
  std::vector<double> load = std::vector<double>(interface_values, 3),
                      columns = std::vector<double>(2 * interface_values, 4);

  void keep(RestartArchive& archive) {
    archive.count_if_there("stepper.age", age);
    archive.number("stepper.factor", factor);
    archive.array("stepper.load", ArrayKind::interface, load);
    archive.array("stepper.columns", ArrayKind::interface_columns, columns, {{}, 2});
  }
};

const std::vector<std::string> others{"stepper.", "table."};

Checkpoint example(TimeAxis& axis) {
  WrittenArchive archive;
  State state = after_four_steps();
  keep(state, archive);
  write_down_steps(axis, state, archive);
  Keeper().keep(archive);
  TableDigests digests{{"flow.csv", {100, 1, 2}}};
  PrefixedArchive of_tables("table.", archive);
  keep(digests, of_tables);
  Checkpoint checkpoint;
  checkpoint.step = state.step;
  checkpoint.time = state.time;
  checkpoint.arrays = archive.arrays;
  checkpoint.kinds = archive.kinds;
  checkpoint.integers = archive.integers;
  checkpoint.reals = archive.numbers;
  return checkpoint;
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
  return example(axis);
}

/// All that a checkpoint gives back.
struct Recalled {
  State state = at_rest();
  Keeper keeper{0, 0, {}, {}};
  TableDigests digests{{"flow.csv", {}}, {"openings.csv", {}}};
  StoredSteps steps;
  std::vector<std::string> left;

  explicit Recalled(const Checkpoint& checkpoint) {
    StoredArrays arrays;
    for (const auto& [name, array] : checkpoint.arrays) arrays.names.push_back(name);
    arrays.read = [&](const std::string& name, ArrayKind) { return checkpoint.arrays.at(name); };
    arrays.length = length;
    RecalledArchive archive(file, checkpoint, arrays);
    recall(checkpoint, archive, state);
    PrefixedArchive of_tables("table.", archive);
    keep(digests, of_tables);
    steps = recall_steps(archive, state, ends);
    keeper.keep(archive);
    left = archive.require_all_known(others);
  }
};

/// What is said of a changed checkpoint; empty: nothing.
std::string said_of(const std::function<void(Checkpoint&)>& change) {
  Checkpoint checkpoint = example();
  change(checkpoint);
  try {
    const Recalled recalled(checkpoint);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(StateCheckpoint, ComesBackAsItWas) {
  const Recalled found(example());
  const State &state = found.state, before = after_four_steps();
  EXPECT_EQ(state.step, 4);
  EXPECT_EQ(state.time, 1.5);
  EXPECT_EQ(state.times, before.times);
  EXPECT_EQ(state.balance_times, before.balance_times);
  EXPECT_EQ(state.before[2].wall, before.before[2].wall);
  EXPECT_EQ(state.balances_since_jump, 4);
  EXPECT_EQ(found.keeper.age, 7);
  EXPECT_EQ(found.keeper.columns, Keeper().columns);
  EXPECT_EQ(found.digests, (TableDigests{{"flow.csv", {100, 1, 2}}}));
  ASSERT_EQ(found.steps.insertions.size(), ends.size());
  for (std::size_t k = 0; k < ends.size(); ++k) {
    EXPECT_EQ(found.steps.insertions[k].step, static_cast<int>(k) + 1);
    EXPECT_EQ(found.steps.insertions[k].end, ends[k]);
  }
}

TEST(StateCheckpoint, TellsTheKindsOfItsArrays) {
  const auto kinds = example().kinds;
  for (const auto& [name, kind] : {std::pair{"level2.mesh", ArrayKind::mesh},
                                   {"balance1.flow", ArrayKind::flow},
                                   {"rate.wall", ArrayKind::wall},
                                   {"wall_velocity_before", ArrayKind::wall_vectors},
                                   {"stepper.columns", ArrayKind::interface_columns},
                                   {"table.flow.csv", ArrayKind::alike}})
    EXPECT_EQ(kinds.at(name), kind) << name;
  EXPECT_EQ(kinds.size(), example().arrays.size());
}

TEST(StateCheckpoint, LeavesAsideWhatAnotherMethodHasKept) {
  Checkpoint checkpoint = example();
  checkpoint.arrays["stepper.iqn_ils.v"] = {1};
  EXPECT_EQ(Recalled(checkpoint).left, std::vector<std::string>{"stepper.iqn_ils.v"});
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
  EXPECT_NO_THROW(Recalled{example(axis)});
}

TEST(StateCheckpoint, WithANumberThatIsNotFiniteIsRefused) {
  const Checkpoint whole = example();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (const auto& [name, array] : whole.arrays)
      for (std::size_t i = 0; i < array.size(); ++i)
        EXPECT_NE(said_of([&, &name = name](Checkpoint& c) { c.arrays[name][i] = bad; }), "") << name << i;
    for (const auto& [name, number] : whole.reals)
      EXPECT_NE(said_of([&, &name = name](Checkpoint& c) { c.reals[name] = bad; }), "") << name;
    EXPECT_NE(said_of([&](Checkpoint& c) { c.time = bad; }), "");
  }
}

TEST(StateCheckpoint, WithAnArrayMissingTooLongOrUnknownIsRefused) {
  const Checkpoint whole = example();
  for (const auto& [name, array] : whole.arrays) {
    if (name.rfind("table.", 0) == 0) continue;
    EXPECT_NE(said_of([&, &name = name](Checkpoint& c) { c.arrays.erase(name); }), "") << name;
    EXPECT_NE(said_of([&, &name = name](Checkpoint& c) { c.arrays[name].push_back(0); }), "") << name;
    if (!array.empty()) {
      EXPECT_NE(said_of([&, &name = name](Checkpoint& c) { c.arrays[name].pop_back(); }), "") << name;
    }
  }
  EXPECT_NE(said_of([](Checkpoint& c) { c.arrays["more"] = {1}; }).find("more: is unknown"), std::string::npos);
  EXPECT_NE(said_of([](Checkpoint& c) { c.reals.erase("stepper.factor"); }), "");
  EXPECT_EQ(said_of([](Checkpoint& c) { c.reals.erase("stepper.age"); }), "") << "it may be missing";
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
  for (const double count : {-1.0, 0.5, 1e300})
    EXPECT_NE(said_of([&](Checkpoint& c) { c.reals["stepper.age"] = count; }), "") << count;
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
