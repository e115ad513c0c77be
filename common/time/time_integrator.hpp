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

/// Why steps of some length cost a scheme its order.
struct LostOrder {
  std::string said;         ///< what it has instead: "... and an error that falls like the step"
  double longest_step = 0;  ///< ms, that keeps the order
  std::string remedy;       ///< besides shorter steps: by the scheme's parameters that the case gives; empty: none
};

/// A time scheme: how rates follow from time levels, and what others need to know. It keeps nothing between
/// steps: all history is in the State. A step has one stage or two; each is one nonlinear solve.
class TimeIntegrator {
 public:
  virtual ~TimeIntegrator() = default;
  virtual bool is_static() const { return false; }
  /// Leading terms of its error, with the constants of docs/theory.md, section 8.
  virtual ErrorTerms error_terms() const = 0;
  /// Where equal steps of this length (ms) cost the scheme its order; else empty.
  virtual std::optional<LostOrder> lost_order(double /*step*/) const { return std::nullopt; }
  /// Whether a partitioned coupling may end a step after one pass; else the residual between fluid and wall comes back
  /// with every step.
  virtual bool bears_one_pass() const { return false; }
  /// What a user can do where pressures alternate from step to step.
  virtual std::string against_ringing() const { return "take time.scheme = \"midpoint\""; }
  /// Of schemes of Newmark's family: how the wall's velocity follows from its accelerations.
  virtual NewmarkParameters newmark() const { return {}; }
  /// What a user should know of it with steps of these lengths (ms), for the log; empty: nothing.
  virtual std::string about(double /*shortest*/, double /*longest*/) const { return {}; }
  /// Period of u = (d - r) / period (InterfaceKinematics) in each stage of equal steps of this length, ms.
  virtual double period(double step) const { return step; }
  /// Gives a state at rest, or with initial values, the history that the scheme keeps.
  virtual void prepare(State&) const {}
  /// Stages of the state's next step.
  virtual int stages(const State&) const { return 1; }
  /// Rates of a stage of a step of length `step` (ms) from the state's finished levels, and stages.
  StepRates rates(const State& state, double step, int stage = 0) const { return rates_of(state, step, stage); }
  /// Writes to state.now where the iteration of a step, or stage, starts: finished levels extrapolated by polynomials
  /// of a degree of at most `order` (0 to 2).
  virtual void predict(State& state, int order, const StepData& data) const { fsi::predict(state, order, data.time); }
  /// The same weights for what belongs to the last three solutions of the equations, such as forces; the latest first.
  virtual std::array<double, 3> balance_weights(const State& state, int order, const StepData& data) const {
    return extrapolation_weights(state, order, data.time);
  }
  /// The balance last solved, made again from the state, where the next step counts it a second time
  /// (StepRates::previous_weight); else empty.
  virtual std::optional<Balance> balance_again(const State&) const { return std::nullopt; }
  /// Takes state.now as the solution of the stage's equations: carries it to the stage's end, updates the scheme's
  /// history and, after the last stage, finishes the step.
  virtual void accept(State& state, const StepData& data) const = 0;
  /// Whether the pressures at a step's end are extrapolated until the next step settles them: they are then best looked
  /// at after that, in before[1].
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
