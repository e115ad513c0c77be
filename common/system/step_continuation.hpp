#pragma once

#include <functional>

#include "time/state.hpp"

namespace fsi {

/// Progress of walk_to_step(), in shares of the step's length.
struct StepWalk {
  double solved = 0;      ///< longest share solved
  double failed = 0;      ///< shortest longer share that failed; 0: none
  int lengths_tried = 0;  ///< solved or failed
  bool arrived() const { return solved == 1; }
};

/// Continuation to the solution of a step from those of shorter ones: each start is extrapolated from the last two, and
/// where one fails the next stride is shorter. Equations of short steps are easier, since inertia dominates, so that a
/// step too long for Newton's method may be reached. Ends where strides shrink to a fiftieth of the step: the solutions
/// end, or turn back.
/// \param now    where the step begins; becomes the solution, or that of the longest step which has one
/// \param solve  solves the equations of a step of this share from `now`; returns whether it converged
StepWalk walk_to_step(Solution& now, const std::function<bool(double share)>& solve);

}  // namespace fsi
