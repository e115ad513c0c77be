#include "driver/state_checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace fsi {

namespace {

constexpr const char* memory_prefix = "stepper.";
constexpr const char* insertions_name = "inserted_steps";  // each: step, its end, its length
constexpr const char* stretches_name = "step_lengths";  // per stretch: step before it, its start, what the case asked

/// Calls visit(name, array) for every array of a state that a later step reads.
template <class StateType, class Visit>
void for_each_array(StateType& state, Visit visit) {
  for (std::size_t level = 0; level < state.before.size(); ++level) {
    visit(fmt::format("level{}.mesh", level), state.before[level].mesh);
    visit(fmt::format("level{}.flow", level), state.before[level].fluid);
    visit(fmt::format("level{}.wall", level), state.before[level].wall);
  }
  visit("wall_velocity", state.wall_velocity);
  visit("wall_acceleration", state.wall_acceleration);
  if (!state.has_balances()) return;  // backward Euler has no more
  for (std::size_t k = 0; k < state.balances.size(); ++k) {
    visit(fmt::format("balance{}.mesh", k), state.balances[k].mesh);
    visit(fmt::format("balance{}.flow", k), state.balances[k].fluid);
    visit(fmt::format("balance{}.wall", k), state.balances[k].wall);
  }
  visit("wall_velocity_before", state.wall_velocity_before);
  visit("rate.mesh", state.rate.mesh);
  visit("rate.flow", state.rate.fluid);
  visit("rate.wall", state.rate.wall);
  visit("rate.wall_velocity", state.velocity_rate);
  visit("rate.loads", state.load_rates);
}

}  // namespace

void store(const State& state, const Memory& memory, const TimeAxis& axis, Checkpoint& checkpoint) {
  checkpoint.step = state.step;
  checkpoint.time = state.time;
  checkpoint.arrays["level_times"] = {state.times.begin(), state.times.end()};
  if (state.has_balances()) {
    checkpoint.arrays["balance_times"] = {state.balance_times.begin(), state.balance_times.end()};
    checkpoint.arrays["since_jump"] = {static_cast<double>(state.since_jump),
                                       static_cast<double>(state.balances_since_jump)};
  }
  auto& numbers = checkpoint.arrays[stretches_name];
  for (const Stretch& stretch : axis.stretches())
    numbers.insert(numbers.end(), {static_cast<double>(stretch.after), stretch.start, stretch.asked});
  if (!axis.insertions().empty()) {
    auto& inserted = checkpoint.arrays[insertions_name];
    for (const Insertion& step : axis.insertions())
      inserted.insert(inserted.end(), {static_cast<double>(step.step), step.end, step.length});
  }
  for_each_array(state,
                 [&](const std::string& name, const std::vector<double>& array) { checkpoint.arrays[name] = array; });
  for (const auto& [name, array] : memory.arrays) checkpoint.arrays[memory_prefix + name] = array;
  for (const auto& [name, number] : memory.numbers) checkpoint.reals[memory_prefix + name] = number;
}

Memory restore(const std::filesystem::path& file, const Checkpoint& checkpoint, State& state) {
  for_each_array(state, [&](const std::string& name, std::vector<double>& array) {
    array = require_size(file, checkpoint, name, array.size());
  });
  const auto& times = require_size(file, checkpoint, "level_times", state.times.size());
  std::copy(times.begin(), times.end(), state.times.begin());
  if (state.has_balances()) {
    const auto& balance_times = require_size(file, checkpoint, "balance_times", state.balance_times.size());
    std::copy(balance_times.begin(), balance_times.end(), state.balance_times.begin());
    const auto& counts = require_size(file, checkpoint, "since_jump", 2);
    state.since_jump = static_cast<int>(counts[0]);
    state.balances_since_jump = static_cast<int>(counts[1]);
  }
  state.step = static_cast<int>(checkpoint.step);
  state.time = checkpoint.time;
  state.now = state.before[0];
  Memory memory;
  const std::string prefix = memory_prefix;
  for (const auto& [name, array] : checkpoint.arrays)
    if (name.rfind(prefix, 0) == 0) memory.arrays[name.substr(prefix.size())] = array;
  for (const auto& [name, number] : checkpoint.reals)
    if (name.rfind(prefix, 0) == 0) memory.numbers[name.substr(prefix.size())] = number;
  return memory;
}

std::vector<Stretch> stored_stretches(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  const auto found = checkpoint.arrays.find(stretches_name);
  const std::size_t size = found == checkpoint.arrays.end() ? 0 : found->second.size();
  const auto& numbers = require_size(file, checkpoint, stretches_name, std::max<std::size_t>(3, size / 3 * 3));
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < numbers.size(); i += 3)
    stretches.push_back({static_cast<int>(numbers[i]), numbers[i + 1], numbers[i + 2]});
  return stretches;
}

std::vector<Insertion> stored_insertions(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  const auto found = checkpoint.arrays.find(insertions_name);
  if (found == checkpoint.arrays.end()) return {};
  const auto& numbers = require_size(file, checkpoint, insertions_name, found->second.size() / 3 * 3);
  std::vector<Insertion> insertions;
  for (std::size_t i = 0; i < numbers.size(); i += 3)
    insertions.push_back({static_cast<int>(numbers[i]), numbers[i + 1], numbers[i + 2]});
  return insertions;
}

}  // namespace fsi
