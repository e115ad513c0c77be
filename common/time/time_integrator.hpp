#pragma once

#include "time/state.hpp"
#include "time/step_data.hpp"

namespace fsi {

/// Parameters of Newmark's method.
struct NewmarkParameters {
  double beta = 1, gamma = 1;
};

/// How rates follow from time levels: a time scheme. It is asked anew for each step, whose length may differ from the
/// last one's, and keeps nothing between steps: all history is in the State.
class TimeIntegrator {
 public:
  virtual ~TimeIntegrator() = default;
  virtual bool is_static() const { return false; }
  /// How the wall's velocity follows from its accelerations.
  virtual NewmarkParameters newmark() const { return {}; }
  /// Rates of a step of length `step` (ms) from the state's finished levels.
  virtual StepRates rates(const State& state, double step) const = 0;
  /// Takes state.now as the result of the step: updates what the scheme needs of it and finishes the step.
  virtual void accept(State& state, const StepData& data) const = 0;
};

/// No time: load steps of a scene without inertia.
class QuasiStatic : public TimeIntegrator {
 public:
  bool is_static() const override { return true; }
  StepRates rates(const State&, double) const override { return {}; }
  void accept(State& state, const StepData& data) const override { state.finish_step(data.time); }
};

}  // namespace fsi
