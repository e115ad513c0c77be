#pragma once

#include <filesystem>
#include <vector>

#include "driver/checkpoint_arrays.hpp"
#include "io/checkpoint.hpp"
#include "io/table_digest.hpp"
#include "scene/time_axis.hpp"
#include "time/state.hpp"
#include "time/stepper.hpp"

namespace fsi {

/// Adds the finished levels of a state, what the stepper keeps between steps, and the steps that led there.
void store(const State& state, const Memory& memory, const TimeAxis& axis, Checkpoint& checkpoint);

/// That the kind of every array is known (checkpoint_arrays.hpp), as those who read it need. \throws std::logic_error
void require_kinds(const Checkpoint& checkpoint);

/// The reverse. Nothing is believed: every number is finite and in its range, every array has the size that the scene
/// gives it, none is missing and none is unknown.
/// \param state             comes at rest, for the sizes
/// \param interface_values  vectors at the nodes between fluid and wall have so many components in all
/// \throws InputError naming `file` and what is wrong there
Memory restore(const std::filesystem::path& file, const Checkpoint& checkpoint, std::size_t interface_values,
               State& state);

/// The steps that led to a checkpoint.
struct StoredSteps {
  std::vector<Stretch> stretches;
  std::vector<Insertion> insertions;  ///< those that were not planned
};

/// Reads them and holds them against the recorded ends of steps, as well as the times of the state's levels and balances.
/// \param ends  of the steps 1 to the last, as iterations.csv has them
/// \throws InputError naming `file` when they do not fit
StoredSteps stored_steps(const std::filesystem::path& file, const Checkpoint& checkpoint, const State& state,
                         const std::vector<double>& ends);

/// What the tables hold at the checkpoint, and the reverse.
void store(const TableDigests& digests, Checkpoint& checkpoint);
TableDigests stored_digests(const Checkpoint& checkpoint);

/// Refuses a checkpoint behind the end of the run (ms; in statics 1). \throws InputError
void require_not_beyond(const std::filesystem::path& file, const State& state, double end);

}  // namespace fsi
