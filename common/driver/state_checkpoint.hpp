#pragma once

#include <filesystem>
#include <vector>

#include "io/checkpoint.hpp"
#include "time/state.hpp"
#include "time/stepper.hpp"
#include "time/time_axis.hpp"

namespace fsi {

/// Adds the finished levels of a state, what the stepper keeps between steps, and the steps that led there.
void store(const State& state, const Memory& memory, const TimeAxis& axis, Checkpoint& checkpoint);

/// The reverse; `state` comes at rest, for the sizes. \throws InputError naming `file` for arrays missing or of another
/// size
Memory restore(const std::filesystem::path& file, const Checkpoint& checkpoint, State& state);

/// The steps that led to the checkpoint. \throws InputError naming `file` when it does not tell
std::vector<Stretch> stored_stretches(const std::filesystem::path& file, const Checkpoint& checkpoint);
/// Those of them that were not planned. \throws as stored_stretches
std::vector<Insertion> stored_insertions(const std::filesystem::path& file, const Checkpoint& checkpoint);

}  // namespace fsi
