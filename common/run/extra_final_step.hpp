#pragma once

#include "case/case.hpp"
#include "run/step_controller.hpp"
#include "scene/loads.hpp"
#include "time/state.hpp"
#include "time/stepper.hpp"

namespace fsi {

/// What one step behind the end of a run has found.
struct ExtraFinalStep {
  State state;  ///< at its end; before[1] is the last level of the run, with the pressures that it has in a longer one
  StepReport report;
};

/// One step behind the end of a run in time, of which nothing is kept: where pressures lag behind the levels
/// (TimeIntegrator::pressures_lag) it alone settles those of the last one. It is the step that a run goes on with which is
/// continued to twice the end: the same load, the same length, halved or refused as any other. So the run's last level gets
/// the bits that it has in the longer run. The stepper and the march do not come back to the end of the run.
/// \param state  at the end of the run; stays as it is
/// \param loads  as they were, afterwards
/// \throws ConvergenceError when the step has no solution; Stopped at a signal (host/stop_request.hpp)
template <int n>
ExtraFinalStep extra_final_step(const Case& setup, const State& state, Loads& loads, StepController<n>& march);

}  // namespace fsi
