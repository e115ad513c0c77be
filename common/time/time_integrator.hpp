#pragma once

#include <optional>
#include <string>

#include "time/error_terms.hpp"
#include "time/predictor.hpp"
#include "time/state.hpp"
#include "time/step_data.hpp"

namespace fsi {

/// Parameters of Newmark's method.
struct NewmarkParameters {
  double beta = 1, gamma = 1;
};

/// A length of steps with which a scheme has no longer its order.
struct LostOrder {
  std::string said;         ///< what it has then: "... and an error that falls like the step"
  double longest_step = 0;  ///< ms, that keeps the order
  std::string remedy;       ///< by the scheme's parameters that the case gives, but for shorter steps; empty: none
};

/// How rates follow from time levels: a time scheme, with all that others decide by it. It is asked anew for each step, whose length may differ from the
/// last one's, and keeps nothing between steps: all history is in the State. A step has one stage or two: each is one
/// nonlinear solve.
class TimeIntegrator {
 public:
  virtual ~TimeIntegrator() = default;
  virtual bool is_static() const { return false; }
  /// How its error begins, with the constants of docs/theory.md, section 8.
  virtual ErrorTerms error_terms() const = 0;
  /// Where equal steps of this length (ms) cost the scheme its order; else empty.
  virtual std::optional<LostOrder> lost_order(double /*step*/) const { return std::nullopt; }
  /// Whether a partitioned coupling may leave a step after one pass. Else what that leaves between fluid and wall comes
  /// back with every step.
  virtual bool bears_one_pass() const { return false; }
  /// What a user can do where pressures alternate from step to step.
  virtual std::string against_ringing() const { return "take time.scheme = \"midpoint\""; }
  /// How the wall's velocity follows from its accelerations, of schemes of Newmark's family.
  virtual NewmarkParameters newmark() const { return {}; }
  /// What a user should know of it with steps of these lengths (ms), for the log; empty: nothing.
  virtual std::string about(double /*shortest*/, double /*longest*/) const { return {}; }
  /// Period of u = (d - r) / period (InterfaceKinematics) in each stage of equal steps of this length, ms: how long the step
  /// is to their solvers.
  virtual double period(double step) const { return step; }
  /// Gives a state at rest, or with initial values, the history that the scheme keeps.
  virtual void prepare(State&) const {}
  /// Stages of the state's next step.
  virtual int stages(const State&) const { return 1; }
  /// Rates of a stage of a step of length `step` (ms) from the state's finished levels, and stages.
  StepRates rates(const State& state, double step, int stage = 0) const { return rates_of(state, step, stage); }
  /// Writes to state.now where the iteration of a step, or stage, starts: finished levels extrapolated by polynomials of
  /// a degree of at most `order` (0 to 2).
  virtual void predict(State& state, int order, const StepData& data) const { fsi::predict(state, order, data.time); }
  /// Weights alike of what belongs to the last three solutions of the equations, the latest first: forces, say.
  virtual std::array<double, 3> balance_weights(const State& state, int order, const StepData& data) const {
    return extrapolation_weights(state, order, data.time);
  }
  /// The balance last solved, made again of the state, where the next step counts it once more
  /// (StepRates::previous_weight).
  virtual std::optional<Balance> balance_again(const State&) const { return std::nullopt; }
  /// Takes state.now as the solution of the stage's equations: carries it to the stage's end, updates what the scheme
  /// needs of it and, after the last stage, finishes the step.
  virtual void accept(State& state, const StepData& data) const = 0;
  /// Whether a step's pressures become known at its end only by those of the next: what belongs to the end of a step is
  /// then best looked at after the next one, as before[1]. Until then they are extrapolated.
  virtual bool pressures_lag() const { return false; }

 private:
  virtual StepRates rates_of(const State& state, double step, int stage) const = 0;
};

/// No time: load steps of a scene without inertia.
class QuasiStatic : public TimeIntegrator {
 public:
  bool is_static() const override { return true; }
  ErrorTerms error_terms() const override { return {}; }
  bool bears_one_pass() const override { return true; }
  void accept(State& state, const StepData& data) const override { state.finish_step(data.time); }

 private:
  StepRates rates_of(const State&, double, int) const override { return {}; }
};

}  // namespace fsi
