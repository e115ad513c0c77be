#pragma once

#include <functional>

#include "time/state.hpp"

namespace fsi {

/// How far a step was walked, in shares of its length.
struct StepWalk {
  double solved = 0;      ///< the longest that was
  double failed = 0;      ///< the shortest beyond it that was not; 0: all were
  int lengths_tried = 0;  ///< that were solved or not
  bool arrived() const { return solved == 1; }
};

/// Walks to the solution of a step from those of shorter ones: each start is extrapolated from the last two, and where one
/// fails the next stride is shorter. Equations of short steps are easier, since mass over time outweighs all else, and a step
/// too long for Newton's method may be reached so. Where strides shrink to a fiftieth the solutions end, or turn back:
/// no longer step is reached.
/// \param now    where the step begins; becomes the solution, or that of the longest step which has one
/// \param solve  solves the equations of a step of this share from `now`; returns whether it could
StepWalk walk_to_step(Solution& now, const std::function<bool(double share)>& solve);

}  // namespace fsi
