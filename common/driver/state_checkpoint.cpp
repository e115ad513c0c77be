#include "driver/state_checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace fsi {

namespace {

constexpr const char* memory_prefix = "stepper.";

/// Calls visit(name, array) for every array of a state that a later step reads.
template <class StateType, class Visit>
void for_each_array(StateType& state, Visit visit) {
  for (std::size_t level = 0; level < state.before.size(); ++level) {
    visit(fmt::format("level{}.mesh", level), state.before[level].mesh);
    visit(fmt::format("level{}.flow", level), state.before[level].flow);
    visit(fmt::format("level{}.wall", level), state.before[level].wall);
  }
  visit("wall_velocity", state.wall_velocity);
  visit("wall_acceleration", state.wall_acceleration);
}

}  // namespace

void store(const State& state, const Memory& memory, Checkpoint& checkpoint) {
  checkpoint.step = state.step;
  checkpoint.time = state.time;
  checkpoint.arrays["level_times"] = {state.times.begin(), state.times.end()};
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

}  // namespace fsi
