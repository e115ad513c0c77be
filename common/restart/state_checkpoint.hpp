#pragma once

#include <filesystem>
#include <vector>

#include "io/checkpoint.hpp"
#include "io/table_digest.hpp"
#include "restart/recalled_archive.hpp"
#include "scene/time_axis.hpp"
#include "time/restart_archive.hpp"
#include "time/state.hpp"

namespace fsi {

/// Writes or recalls the finished levels of a state and what its time scheme keeps besides. Where the archive recalls,
/// the state comes at rest, for the sizes.
void keep(State& state, RestartArchive& archive);

/// A state from a checkpoint, with step and time; checks that times are in order and counts in their range.
/// \param state  comes at rest \throws InputError naming the file and what is wrong there
void recall(const Checkpoint& head, RecalledArchive& archive, State& state);

/// The steps that led to a checkpoint.
struct StoredSteps {
  std::vector<Stretch> stretches;
  std::vector<Insertion> insertions;  ///< those that were not planned
};
void write_down_steps(const TimeAxis& axis, const State& state, RestartArchive& archive);
/// Checks them, and the times of the state's levels, against the recorded ends of steps.
/// \param ends  ms, of the steps 1 to state.step, as iterations.csv has them
/// \throws InputError naming the file when they do not fit
StoredSteps recall_steps(RecalledArchive& archive, const State& state, const std::vector<double>& ends);

/// Digests of the result tables at the checkpoint, by file. Recalling looks up the keys that are there and erases those
/// that the checkpoint does not have.
void keep(TableDigests& digests, RestartArchive& archive);

/// Refuses a checkpoint later than the end of the run (ms; in statics 1). \throws InputError
void require_not_beyond(const std::filesystem::path& file, const State& state, double end);

}  // namespace fsi
