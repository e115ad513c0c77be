#pragma once

#include <filesystem>

#include "io/checkpoint.hpp"
#include "time/state.hpp"
#include "time/stepper.hpp"

namespace fsi {

/// Adds the finished levels of a state and what the stepper keeps between steps.
void store(const State& state, const Memory& memory, Checkpoint& checkpoint);

/// The reverse; `state` comes at rest, for the sizes. \throws InputError naming `file` for arrays missing or of another
/// size
Memory restore(const std::filesystem::path& file, const Checkpoint& checkpoint, State& state);

}  // namespace fsi
