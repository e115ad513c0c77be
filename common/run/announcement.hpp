#pragma once

#include "io/run_log.hpp"
#include "run/console.hpp"
#include "run/run_checkpoints.hpp"
#include "run/run_parts.hpp"

namespace fsi {

/// What a run says when it begins, or goes on: what it is, what was decided where the case leaves a choice, and what the user
/// should know. Choices go into the summary, too.
template <int n>
void announce(RunParts<n>& parts, const RunCheckpoints<n>& checkpoints, Console& console, RunLog& log);

}  // namespace fsi
