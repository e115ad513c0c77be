#include "driver/state_checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

#include "base/error.hpp"
#include "time/time_rounding.hpp"

namespace fsi {

namespace fs = std::filesystem;

namespace {

constexpr double most_steps = std::numeric_limits<int>::max();
constexpr std::size_t most_openings = 100000;

constexpr const char* insertions_name = "inserted_steps";  // each: step, its end, its length
constexpr const char* inserted_until = "inserted_until";   // steps 1 to this were all inserted: iterations.csv has them
constexpr const char* stretches_name = "step_lengths";  // per stretch: step before it, its start, what the case asked
constexpr const char* level_times = "level_times";
constexpr const char* balance_times = "balance_times";
constexpr const char* since_jump = "since_jump";
constexpr const char* another_version = "the checkpoint comes from another version; run from the start";
constexpr const char* damaged = "the checkpoint is damaged; restart from another folder, or run from the start";

/// Calls visit(name, array) for every array of a state that a later step reads.
template <class StateType, class Visit>
void for_each_array(StateType& state, Visit visit) {
  for (std::size_t level = 0; level < state.before.size(); ++level) {
    visit(fmt::format("level{}.mesh", level), state.before[level].mesh);
    visit(fmt::format("level{}.flow", level), state.before[level].fluid);
    visit(fmt::format("level{}.wall", level), state.before[level].wall);
    if (!state.before[level].openings.empty())
      visit(fmt::format("level{}.windkessel", level), state.before[level].openings);
  }
  visit("wall_velocity", state.wall_velocity);
  visit("wall_acceleration", state.wall_acceleration);
  if (!state.has_balances()) return;  // backward Euler has no more
  for (std::size_t k = 0; k < state.balances.size(); ++k) {
    visit(fmt::format("balance{}.mesh", k), state.balances[k].mesh);
    visit(fmt::format("balance{}.flow", k), state.balances[k].fluid);
    visit(fmt::format("balance{}.wall", k), state.balances[k].wall);
    if (!state.balances[k].openings.empty()) visit(fmt::format("balance{}.windkessel", k), state.balances[k].openings);
  }
  visit("wall_velocity_before", state.wall_velocity_before);
  visit("rate.mesh", state.rate.mesh);
  visit("rate.flow", state.rate.fluid);
  visit("rate.wall", state.rate.wall);
  if (!state.rate.openings.empty()) visit("rate.windkessel", state.rate.openings);
  visit("rate.wall_velocity", state.velocity_rate);
  visit("rate.loads", state.load_rates);
}

[[noreturn]] void refuse(const fs::path& file, const std::string& name, const std::string& problem,
                         const std::string& remedy = damaged) {
  throw InputError(file.string(), name, problem, remedy);
}

bool begins_with(const std::string& text, const std::string& prefix) {
  return text.compare(0, prefix.size(), prefix) == 0;
}

bool ends_with(const std::string& text, const std::string& suffix) {
  return text.size() >= suffix.size() && text.compare(text.size() - suffix.size(), suffix.size(), suffix) == 0;
}

/// A whole number among doubles.
int whole(const fs::path& file, const std::string& name, double number, double least, double most) {
  if (!(number >= least && number <= most) || number != std::floor(number))
    refuse(file, name, fmt::format("holds {:g}, no whole number from {:g} to {:g}", number, least, most));
  return static_cast<int>(number);
}

void require_finite(const fs::path& file, const Checkpoint& checkpoint) {
  if (!std::isfinite(checkpoint.time)) refuse(file, "time", "is not finite");
  for (const auto& [name, array] : checkpoint.arrays)
    if (!std::all_of(array.begin(), array.end(), [](double number) { return std::isfinite(number); }))
      refuse(file, name, "holds a number that is not finite");
  for (const auto& [name, number] : checkpoint.reals)
    if (!std::isfinite(number)) refuse(file, name, "is not finite");
}

/// What the steppers and the march keep: arrays of a linearisation point are as long as the state's, columns of
/// differences as long as the interface's vectors.
void check_memory(const fs::path& file, const Checkpoint& checkpoint, std::size_t interface_values,
                  const State& state) {
  const auto require = [&](const std::string& name, std::size_t found, std::size_t size) {
    if (found != size)
      refuse(file, name, fmt::format("has {} values, not {}", found, size),
             "restart with the case and mesh of that run");
  };
  const auto size_of = [&](const std::string& name) {
    const auto found = checkpoint.arrays.find(name);
    if (found == checkpoint.arrays.end()) refuse(file, name, "missing", another_version);
    return found->second.size();
  };
  for (const auto& [name, array] : checkpoint.arrays) {
    const bool of_march = begins_with(name, march_prefix);
    if (!of_march && !begins_with(name, memory_prefix)) continue;
    const auto kind = kind_of_array(name);
    if (!kind) refuse(file, name, "is unknown", another_version);
    const auto stem = name.substr(0, name.rfind('.'));
    switch (*kind) {
      case ArrayKind::mesh:
        require(name, array.size(), state.now.mesh.size());
        break;
      case ArrayKind::flow:
        require(name, array.size(), state.now.fluid.size());
        break;
      case ArrayKind::wall:
        require(name, array.size(), state.now.wall.size());
        break;
      case ArrayKind::interface:
        require(name, array.size(), interface_values);
        for (const char* load : {"load0", "load1", "load2"}) size_of(std::string(memory_prefix) + load);
        break;
      case ArrayKind::interface_columns: {
        const bool aged = ends_with(name, ".v") || ends_with(name, ".w");
        const auto columns =
            aged ? size_of(stem + ".age")
                 : static_cast<std::size_t>(
                       whole(file, stem + ".rank", require_real(file, checkpoint, stem + ".rank"), 0, most_steps));
        require(name, array.size(), columns * interface_values);
        break;
      }
      default:
        if (of_march) {
          require(name, array.size(), ends_with(name, ".controller") ? 3 : 4);
        } else if (ends_with(name, ".support_loads")) {
          require(name, array.size(), state.support_loads);
        } else if (ends_with(name, ".windkessels") || ends_with(name, ".opening_values")) {
          require(name, array.size(), state.now.openings.size());
        } else if (ends_with(name, ".opening_pressures")) {
          if (array.size() > most_openings) refuse(file, name, "is too long", another_version);
        } else if (ends_with(name, ".age")) {
          for (const double age : array) whole(file, name, age, 0, most_steps);
          size_of(stem + ".v");
          size_of(stem + ".w");
        } else {
          refuse(file, name, "is unknown", another_version);
        }
    }
    // A linearisation point has all of its parts or none.
    for (const char* part : {".mesh", ".flow", ".wall", ".mesh_reference", ".flow_reference"})
      if (ends_with(name, part)) require_real(file, checkpoint, stem + ".step");
  }
  for (const auto& [name, number] : checkpoint.reals) {
    const auto stem = name.substr(0, name.rfind('.'));
    if (ends_with(name, ".rank")) {
      size_of(stem + ".a");
      size_of(stem + ".b");
    }
    for (const char* count : {".alternating_steps", ".steps_apart", ".before.age"})
      if (ends_with(name, count)) whole(file, name, number, 0, most_steps);
    if (!ends_with(name, ".step")) continue;
    for (const char* part : {".mesh", ".flow", ".wall", ".mesh_reference", ".flow_reference"}) size_of(stem + part);
    for (const char* part : {".period", ".flow_factor", ".acceleration_factor", ".wall_pressure"})
      require_real(file, checkpoint, stem + part);
  }
}

/// Every array has a reader.
void require_known(const fs::path& file, const Checkpoint& checkpoint, const State& state) {
  std::set<std::string> known{level_times, balance_times, since_jump, stretches_name, insertions_name};
  for_each_array(state, [&](const std::string& name, const std::vector<double>&) { known.insert(name); });
  for (const auto& [name, array] : checkpoint.arrays)
    if (known.count(name) == 0 && !begins_with(name, memory_prefix) && !begins_with(name, march_prefix) &&
        !begins_with(name, digest_prefix) && !begins_with(name, statistics_prefix))
      refuse(file, name, "is unknown", another_version);
}

/// Times of levels, or balances, the latest first: as many as there are steps, descending, and 0 before the first.
template <std::size_t count>
void require_descending(const fs::path& file, const char* name, const std::array<double, count>& times, double latest) {
  double after = latest * (1 + time_rounding);
  for (const double time : times) {
    if (!(time >= 0 && time <= after) || (time == after && time > 0))
      refuse(file, name, fmt::format("holds {:g} before {:g}: times are out of order", time, after));
    after = time;
  }
}

std::vector<Stretch> stored_stretches(const fs::path& file, const Checkpoint& checkpoint, const State& state) {
  const auto found = checkpoint.arrays.find(stretches_name);
  const std::size_t size = found == checkpoint.arrays.end() ? 0 : found->second.size();
  const auto& numbers = require_size(file, checkpoint, stretches_name, std::max<std::size_t>(3, size / 3 * 3));
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    const Stretch stretch{whole(file, stretches_name, numbers[i], 0, state.step), numbers[i + 1], numbers[i + 2]};
    const bool first = stretches.empty();
    if (!(stretch.asked >= 0) || !(stretch.start >= 0 && stretch.start <= state.time * (1 + time_rounding)) ||
        (first && stretch.after != 0) ||
        (!first && (stretch.after <= stretches.back().after || !(stretch.start > stretches.back().start))))
      refuse(file, stretches_name, fmt::format("stretch {} is out of order", stretches.size() + 1));
    stretches.push_back(stretch);
  }
  return stretches;
}

std::vector<Insertion> stored_insertions(const fs::path& file, const Checkpoint& checkpoint, const State& state,
                                         const std::vector<double>& ends) {
  std::vector<Insertion> insertions;
  if (const auto until = checkpoint.integers.find(inserted_until); until != checkpoint.integers.end()) {
    const int last = whole(file, inserted_until, static_cast<double>(until->second), 0, state.step);
    for (int step = 1; step <= last; ++step) {
      const double start = step == 1 ? 0 : ends[step - 2];
      insertions.push_back({step, ends[step - 1], ends[step - 1] - start});
    }
  }
  const auto found = checkpoint.arrays.find(insertions_name);
  if (found == checkpoint.arrays.end()) return insertions;
  const auto& numbers = require_size(file, checkpoint, insertions_name, found->second.size() / 3 * 3);
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    const Insertion step{whole(file, insertions_name, numbers[i], 1, most_steps), numbers[i + 1], numbers[i + 2]};
    const bool finished = step.step <= state.step;
    const double end = finished ? ends[step.step - 1] : state.time;
    if (!(step.length > 0) || (finished ? std::abs(step.end - end) > time_rounding * end : step.end <= end) ||
        (!insertions.empty() && (step.step <= insertions.back().step || step.end <= insertions.back().end)))
      refuse(file, insertions_name, fmt::format("step {} is out of order", step.step));
    insertions.push_back(step);
  }
  return insertions;
}

}  // namespace

void store(const State& state, const Memory& memory, const TimeAxis& axis, Checkpoint& checkpoint) {
  checkpoint.step = state.step;
  checkpoint.time = state.time;
  checkpoint.arrays[level_times] = {state.times.begin(), state.times.end()};
  if (state.has_balances()) {
    checkpoint.arrays[balance_times] = {state.balance_times.begin(), state.balance_times.end()};
    checkpoint.arrays[since_jump] = {static_cast<double>(state.since_jump),
                                     static_cast<double>(state.balances_since_jump)};
  }
  auto& numbers = checkpoint.arrays[stretches_name];
  // An adaptive step that found no solution leaves a plan from its own end on.
  for (const Stretch& stretch : axis.stretches())
    numbers.insert(numbers.end(),
                   {static_cast<double>(stretch.after), std::min(stretch.start, state.time), stretch.asked});
  // Of adaptive steps iterations.csv tells the ends: so a checkpoint does not grow with their number. The last one keeps
  // its length to the last bit.
  const auto& insertions = axis.insertions();
  std::size_t told = 0;
  while (told < insertions.size() && insertions[told].step == static_cast<int>(told) + 1 &&
         insertions[told].step < state.step)
    ++told;
  if (told > 0) checkpoint.integers[inserted_until] = static_cast<std::int64_t>(told);
  if (told < insertions.size()) {
    auto& inserted = checkpoint.arrays[insertions_name];
    for (std::size_t i = told; i < insertions.size(); ++i)
      inserted.insert(inserted.end(),
                      {static_cast<double>(insertions[i].step), insertions[i].end, insertions[i].length});
  }
  for_each_array(state,
                 [&](const std::string& name, const std::vector<double>& array) { checkpoint.arrays[name] = array; });
  for (const auto& [name, array] : memory.arrays) checkpoint.arrays[memory_prefix + name] = array;
  for (const auto& [name, number] : memory.numbers) checkpoint.reals[memory_prefix + name] = number;
}

void require_kinds(const Checkpoint& checkpoint) {
  for (const auto& [name, array] : checkpoint.arrays)
    if (!kind_of_array(name)) throw std::logic_error("checkpoint_arrays.cpp does not know the kind of " + name);
}

Memory restore(const fs::path& file, const Checkpoint& checkpoint, std::size_t interface_values, State& state) {
  require_finite(file, checkpoint);
  if (checkpoint.step < 1 || checkpoint.step > most_steps)
    refuse(file, "step", fmt::format("is {}, not from 1 to {}", checkpoint.step, most_steps));
  if (!(checkpoint.time > 0)) refuse(file, "time", fmt::format("is {:g}, not positive", checkpoint.time));
  require_known(file, checkpoint, state);
  check_memory(file, checkpoint, interface_values, state);
  for_each_array(state, [&](const std::string& name, std::vector<double>& array) {
    array = require_size(file, checkpoint, name, array.size());
  });
  state.step = static_cast<int>(checkpoint.step);
  state.time = checkpoint.time;
  const auto& times = require_size(file, checkpoint, level_times, state.times.size());
  std::copy(times.begin(), times.end(), state.times.begin());
  if (state.has_balances()) {
    const auto& of_balances = require_size(file, checkpoint, balance_times, state.balance_times.size());
    std::copy(of_balances.begin(), of_balances.end(), state.balance_times.begin());
    require_descending(file, balance_times, state.balance_times, state.time);
    const auto& counts = require_size(file, checkpoint, since_jump, 2);
    state.since_jump = whole(file, since_jump, counts[0], 0, state.step);
    // One balance a step, or two.
    state.balances_since_jump = whole(file, since_jump, counts[1], state.since_jump, 2.0 * state.since_jump);
  }
  state.now = state.before[0];
  Memory memory;
  const std::string prefix = memory_prefix;
  for (const auto& [name, array] : checkpoint.arrays)
    if (begins_with(name, prefix)) memory.arrays[name.substr(prefix.size())] = array;
  for (const auto& [name, number] : checkpoint.reals)
    if (begins_with(name, prefix)) memory.numbers[name.substr(prefix.size())] = number;
  return memory;
}

StoredSteps stored_steps(const fs::path& file, const Checkpoint& checkpoint, const State& state,
                         const std::vector<double>& ends) {
  for (std::size_t k = 0; k < state.times.size(); ++k) {
    const int step = state.step - static_cast<int>(k);
    const double end = step > 0 ? ends.at(step - 1) : 0;
    if (std::abs(state.times[k] - end) > time_rounding * end)
      refuse(file, level_times,
             fmt::format("says that step {} ended at {:.12g}, iterations.csv at {:.12g}", step, state.times[k], end),
             "restart from a folder as its run has left it, or run from the start");
  }
  StoredSteps steps{stored_stretches(file, checkpoint, state), stored_insertions(file, checkpoint, state, ends)};
  // Adaptive steps are all inserted, the last one with its own length.
  const auto last = static_cast<std::size_t>(state.step);
  const auto until = checkpoint.integers.find(inserted_until);
  if (steps.stretches.back().asked == 0 &&
      (steps.insertions.size() < last || steps.insertions[last - 1].step != state.step ||
       (until != checkpoint.integers.end() && until->second >= state.step)))
    refuse(file, insertions_name, fmt::format("lacks one of the {} adaptive steps", state.step));
  return steps;
}

void store(const TableDigests& digests, Checkpoint& checkpoint) {
  for (const auto& [file, numbers] : digests) checkpoint.arrays[digest_prefix + file] = numbers;
}

TableDigests stored_digests(const Checkpoint& checkpoint) {
  TableDigests digests;
  for (const auto& [name, numbers] : checkpoint.arrays)
    if (begins_with(name, digest_prefix)) digests[name.substr(std::string(digest_prefix).size())] = numbers;
  return digests;
}

void require_not_beyond(const fs::path& file, const State& state, double end) {
  if (state.time > end * (1 + time_rounding))
    refuse(file, "time", fmt::format("{:g} ms, is behind the run's end at {:g} ms", state.time, end),
           fmt::format("give time.end = {:g} or more", state.time));
}

}  // namespace fsi
