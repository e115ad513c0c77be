#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "partitioned/schemes/robin_robin_stepper.hpp"
#include "restart/state_checkpoint.hpp"

namespace fsi {

/// The time integration by robin-robin that predicts for robin-robin-corrected, from the same state and with the same
/// steps. The correction does not enter it, so that its splitting error varies smoothly with time.
template <int n>
class PredictorStepper {
 public:
  /// \param setup   of the run, but for the coefficient of the scheme
  /// \param scheme  the one that is predicted for, must outlive this
  PredictorStepper(Scene<n>& scene, const Loads& loads, const Case& setup, const CouplingScheme& scheme)
      : scene_(scene),
        stepper_(scene, loads, setup, scheme, std::make_unique<RobinRobin<n>>(scene, setup.partitioned)) {}

  /// Solves the next step, which becomes the latest level with finish_step() only.
  /// \param corrected  state of the corrected scheme: the start of the first step; later its step and time alone are
  ///                   read
  /// \throws ConvergenceError
  const StepReport& solve_step(const State& corrected) {
    if (!state_) state_ = corrected;
    next_ = *state_;
    next_.step = corrected.step;
    next_.time = corrected.time;
    stepper_.solve_step(next_);
    return stepper_.report();
  }
  void finish_step() {
    stepper_.finish_step(next_);
    std::swap(*state_, next_);
  }
  const RobinRobinStepper<n>& stepper() const { return stepper_; }

  /// Where another scheme has written the checkpoint the march begins with the next step.
  void keep(RestartArchive& archive) {
    PrefixedArchive own("predicted_", archive);
    if (archive.recalls()) {
      if (!own.has("wall_velocity")) return;
      state_ = scene_.at_rest();
    }
    if (!state_) return;
    fsi::keep(*state_, own);
    state_->now = state_->before[0];
    stepper_.keep(own);
  }

 private:
  Scene<n>& scene_;
  RobinRobinStepper<n> stepper_;
  std::optional<State> state_;  ///< at the end of the last step; empty before the first
  State next_;                  ///< of the step in progress
};

}  // namespace fsi
