#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "case/case.hpp"
#include "partitioned/divergence.hpp"
#include "partitioned/interface_space.hpp"
#include "partitioned/scheme_choice.hpp"
#include "partitioned/schemes.hpp"
#include "scene/scene.hpp"
#include "time/loads.hpp"
#include "time/stepper.hpp"

namespace fsi {

template <int n>
class InterfaceProblem;
struct Pass;
class PassFailure;

/// Advances fluid and wall in turn: passes through the sub-problems from an extrapolated guess, accelerated by the
/// case's scheme, until they agree on the interface.
template <int n>
class CouplingStepper : public Stepper {
 public:
  CouplingStepper(Scene<n>& scene, const Loads& loads, const Case& setup);

  ~CouplingStepper() override;

  bool reports_coupling() const override { return true; }
  std::vector<StepperChoice> choices() const override { return {{"partitioned.scheme", choice_.name, choice_.reason}}; }

  StepReport advance(State& state) override;
  /// Without iterations a march fails because it is unstable, which smaller steps do not mend.
  bool can_retry() const override { return !scheme_.one_pass; }
  /// One pass a step: its monitor speaks after some steps only.
  std::string unchecked() const override;

  void keep(Memory& memory) override;

 private:
  static constexpr int most_retreats = 10;        ///< failed passes of one step
  static constexpr double retreat_factor = 0.25;  ///< of the way from the last good iterate, after a failed pass
  /// Relative interface residual beyond which the wall is linearised: there d~ lies so far off, a hundred times the
  /// error of d, that its nonlinearity would only mislead the accelerator.
  static constexpr double far = 0.8;
  /// Ratio of two periods of the interface's kinematics up to which differences of passes serve as they are.
  static constexpr double likeness = 1.2;
  static constexpr double sub_problem_share = 0.01;  ///< tolerance of the sub-problems over the interface residual
  static constexpr double sub_problem_rounding =
      1e-13;  ///< below it increments of their Newton iterations are rounding
  /// Relative interface residual that is rounding of the displacements: no pass makes it smaller, also where steps are so
  /// short that it is worth a pressure.
  static constexpr double displacement_rounding = 1e-13;
  /// Of the wall's thickness: how small motions of a wall under prestress still have a relative error, each component's
  /// root mean square. Below that they are compared with this.
  static constexpr double smallest_motion = 1e-5;

  /// Iterations are the fewer the closer they start. Without them a step is its extrapolation, and the second order
  /// makes it unstable at three times the wall's mass (docs/coupling.md).
  int first_order() const { return predictor_.value_or(scheme_.one_pass ? 1 : 2); }

  bool weighs_pressure() const { return options_.tolerance_of == ToleranceOf::pressure; }
  /// The tightest of the demands on the interface, as one on |d~ - d| / |d~|; that on the pressure as the last pass
  /// weighs it.
  double demand() const;
  /// Sub-problems are solved a hundred times tighter than the interface; early passes as loosely as their residual
  /// allows.
  double final_tolerance() const { return std::max(sub_problem_share * demand(), sub_problem_rounding); }
  double first_tolerance() const { return std::max(1e-4, final_tolerance()); }

  /// The last pass of a stage that succeeded.
  struct GoodPass {
    bool found = false;
    std::vector<double> x;
    Solution fields;
    double gap = 0;  ///< |r(x)|, mm
  };

  /// Solves a step, or one stage of it; leaves its solution in state.now.
  void advance_stage(State& state, StepData& data);

  void start(State& state, StepData& data);
  /// Warns where the scheme is made for steps that are shorter than the case's.
  void note_long_steps(const Case& setup);
  /// Tells the accelerator when the interface's displacements weigh otherwise than they did.
  void note_period(double period);

  void measure(const Pass& pass);
  bool agrees() const;

  void log_pass();

  [[noreturn]] void give_up(const State& state, const StepData& data, const char* what) const;

  /// The fluid's added mass over what the wall answers a push of the interface with, both within the stage: the size G
  /// of the largest eigenvalue of d -> d~ at rest, by power iteration, an estimate from below. 0: no answer.
  double added_mass(const State& state, const StepData& data);
  /// With one pass a step and an extrapolation of order p, steps that alternate grow where G > 1/3^(p-1), whatever the
  /// time scheme; with backward Euler and Newmark's beta = gamma = 1 from half of that on (docs/coupling.md).
  /// \throws ConvergenceError there, before the first step
  void check_added_mass(const State& state, const StepData& data);
  /// One pass a step, and no claim that fluid and wall agree: a march that has become unstable ends here, long before
  /// an element is inverted, and so does one that lingers at its stability limit with a pressure that means nothing.
  void check_march(const State& state, const StepData& data);

  /// After a pass without an answer: back to the last good iterate and a part of the way again; without one, back to
  /// the last time level. \throws ConvergenceError when that has been tried often enough
  void retreat(const PassFailure& failure, State& state, StepData& data, std::vector<double>& x, const GoodPass& good);

  /// What the accepted pass lacks, relative to what the step changes: with rho the ratio of its residual and that of
  /// the pass before, rho / (1 - rho) times what the fields have changed since, as NewtonReport::error has it. Of a pass
  /// without one before, or with a larger residual, the interface's relative residuals, of displacement and pressures.
  double estimated_error(const State& state, const StepData& data, const GoodPass& good) const;

  void accept(const std::vector<double>& x, const Pass& pass);

  Scene<n>& scene_;
  const Loads& loads_;
  PartitionedData options_;
  std::optional<int> predictor_;  ///< order of the extrapolated start that the case asks for
  SchemeChoice choice_;
  const CouplingScheme& scheme_;
  InterfaceSpace space_;
  std::vector<double> fluid_volumes_, wall_volumes_;  ///< of the nodes, mm^3
  std::unique_ptr<Accelerator> accelerator_;
  std::unique_ptr<InterfaceProblem<n>> problem_;
  CouplingReport coupling_;
  DivergenceMonitor monitor_;        ///< of the step's passes
  AlternationMonitor march_;         ///< of the steps, with one pass each,
  VelocityGapMonitor velocity_gap_;  ///< and of what they leave
  int passes_ = 0;                   ///< of the stage in progress
  int steps_ = 0;                    ///< finished, of the whole run
  int order_ = 0;                    ///< of the extrapolated start
  double period_ = 0;                ///< ms, of the interface's kinematics that the accelerator knows; 0: none yet
  bool starts_far_ = true;           ///< the last step's first guess was far from its end
};

}  // namespace fsi
