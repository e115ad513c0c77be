#pragma once

#include <cstdint>

namespace fsi {

/// What a time step (or load step) cost: a row of iterations.csv and of the console.
struct StepRecord {
  std::int64_t step = 0;               ///< 1 is the first
  double time = 0;                     ///< ms, at the end of the step
  std::int64_t outer_iterations = 0;   ///< coupling iterations; 1 in a monolithic step
  std::int64_t newton_iterations = 0;  ///< all Newton iterations of the step
  std::int64_t linear_iterations = 0;  ///< all Krylov iterations of the step; 0 with a direct solver
  double wall_seconds = 0;             ///< wall-clock time
  double solver_error = 0;             ///< as in StepReport; 0: nothing but rounding
};

}  // namespace fsi
