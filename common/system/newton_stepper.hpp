#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "scene/loads.hpp"
#include "system/system.hpp"
#include "time/stepper.hpp"

namespace fsi {

/// Lines of the paper's Table 3: iteration, increment, residual.
void append_history(const NewtonReport& report, std::vector<std::string>& lines, const std::string& indent = "");

/// The point that a system's Jacobian was made at, if there is one; recalling, the system is linearised there again.
/// \param prepare  called before that
template <int n>
void keep_linearisation(const std::string& name, System<n>& system, RestartArchive& archive,
                        const std::function<void(const StepRates&)>& prepare = {});

/// Advances a scene by Newton's method, whatever its equations are to that.
template <int n>
class NewtonStepperBase : public Stepper {
 public:
  /// If it persists, a step in time that Newton's method does not reach is walked to from shorter ones (walk_to_step()).
  StepReport advance(State& state) override;

 protected:
  NewtonStepperBase(Scene<n>& scene, const Loads& loads, NewtonOptions options);

  /// The equations of a step, or of one stage of it; state.now holds the first guess.
  virtual NewtonProblem& equations(State& state, StepData& data) = 0;
  /// The stage is solved: state.now is its solution.
  virtual void finish_stage(const State& /*state*/, const StepData& /*data*/) {}
  /// The stage has no solution, or the step is refused, and may be taken again in another way.
  virtual void abandon() {}

  const NewtonOptions& options() const { return options_; }
  /// Stepper::choices() on when a step is solved, which the case need not say.
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
  /// By solutions of shorter steps. The failure of one that does not arrive is what there is to add to that of the usual way.
  NewtonReport solve_slowly(State& state, StepData& data);

  State spare_;  ///< storage
  const Loads& loads_;
  NewtonOptions options_;
};

/// Advances a whole scene at once: the monolithic method for fluid and wall, and the only one there is for a scene with
/// one of them.
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
