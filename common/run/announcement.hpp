#pragma once

#include "io/run_log.hpp"
#include "run/console.hpp"
#include "run/run_checkpoints.hpp"
#include "run/run_parts.hpp"

namespace fsi {

/// Writes to console and log what a run is when it begins, or goes on: sizes, what was decided where the case leaves a
/// choice, and warnings. Puts linear solver, coupling, choices, wall thickness and varying constants into the summary.
/// To be called after RunAccount::begin(), whose summary it reads.
template <int n>
void announce(RunParts<n>& parts, const RunCheckpoints<n>& checkpoints, Console& console, RunLog& log);

}  // namespace fsi
