#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "scene/loads.hpp"
#include "system/system.hpp"
#include "time/stepper.hpp"

namespace fsi {

/// Appends a line for each iteration, as in Table 3 of [Langer2018]: iteration, increment, residual.
void append_history(const NewtonReport& report, std::vector<std::string>& lines, const std::string& indent = "");

/// Keeps the point at which a system's Jacobian was made, if there is one. Recalling, the system is linearised there
/// again, unless the step has changed.
/// \param prepare  called before that
template <int n>
void keep_linearisation(const std::string& name, System<n>& system, RestartArchive& archive,
                        const std::function<void(const StepRates&)>& prepare = {});

/// Advances a scene by Newton's method; subclasses choose the equations and unknowns.
template <int n>
class NewtonStepperBase : public Stepper {
 public:
  /// A step that fails is solved again from the last time level and, if it persists, by shorter steps (walk_to_step()).
  StepReport advance(State& state) override;

 protected:
  NewtonStepperBase(Scene<n>& scene, const Loads& loads, NewtonOptions options);

  /// The equations of a step, or of one stage of it; state.now holds the first guess.
  virtual NewtonProblem& equations(State& state, StepData& data) = 0;
  /// Called when a stage is solved, state.now being its solution.
  virtual void finish_stage(const State& /*state*/, const StepData& /*data*/) {}
  /// Called when a stage fails or the judge rejects the step, which may be tried again.
  virtual void abandon() {}

  const NewtonOptions& options() const { return options_; }
  /// The part of Stepper::choices() on when a step is solved.
  std::vector<StepperChoice> stopping() const;

  Scene<n>& scene_;

 private:
  std::string remedy(const NewtonReport& failed) const;

  StepReport advance_all_stages(State& state);
  /// Solves the equations of a step, or of one stage of it; leaves their solution in state.now.
  void advance_stage(State& state, StepData& data);

  /// \param predictor  order of the extrapolated start
  NewtonReport solve(State& state, StepData& data, int predictor);
  /// From state.now.
  NewtonReport solve_from_there(State& state, StepData& data, const NewtonOptions& options);
  /// By solutions of shorter steps. A failure's text is to be appended to that of the usual way.
  NewtonReport solve_slowly(State& state, StepData& data);

  State spare_;  ///< storage
  const Loads& loads_;
  NewtonOptions options_;
};

/// Advances a whole scene at once: the monolithic method for fluid and wall, and the only one for a scene with one
/// medium.
template <int n>
class NewtonStepper : public NewtonStepperBase<n> {
 public:
  /// \param numbering  of the whole scene
  NewtonStepper(Scene<n>& scene, const Loads& loads, NewtonOptions options, Numbering numbering,
                const LinearSolverFactory<n>& make_solver = {});

  const System<n>& system() const { return system_; }

  std::vector<StepperChoice> choices() const override;
  std::optional<CouplingMethod> coupling_method() const override;
  MatrixValues matrix_values() const override { return {system_.fluid_values(), system_.wall_values()}; }
  void keep(RestartArchive& archive) override;
  void forget() override { system_.forget_jacobian(); }

 private:
  NewtonProblem& equations(State& state, StepData& data) override;
  void abandon() override { forget(); }

  System<n> system_;
};

}  // namespace fsi
