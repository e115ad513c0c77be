#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "case/case.hpp"
#include "partitioned/agreement.hpp"
#include "partitioned/coupling_scheme.hpp"
#include "partitioned/divergence.hpp"
#include "partitioned/interface_space.hpp"
#include "scene/loads.hpp"
#include "scene/scene.hpp"
#include "time/stepper.hpp"

namespace fsi {

template <int n>
class CouplingPass;
struct Pass;
struct PassAccuracy;
class PassFailure;

/// Advances fluid and wall by an interface iteration: accelerated passes through the sub-problems, from an extrapolated
/// guess, until both agree on the interface. A scheme that differs is a derived class (schemes/), which overrides the
/// virtual functions below. All processes call each function together.
template <int n>
class CouplingStepper : public Stepper {
 public:
  /// \param scheme   must outlive this
  /// \param problem  what a pass does
  CouplingStepper(Scene<n>& scene, const Loads& loads, const Case& setup, const CouplingScheme& scheme,
                  std::unique_ptr<CouplingPass<n>> problem);
  ~CouplingStepper() override;

  std::optional<CouplingMethod> coupling_method() const override;
  bool reports_coupling() const override { return true; }
  std::vector<StepperChoice> choices() const override { return choices_; }
  MatrixValues matrix_values() const override;

  StepReport advance(State& state) override;
  /// First part of advance(): solves all stages. Where the judge rejects the solution, report().rejected is set.
  /// \throws ConvergenceError; what the step changed in the accelerator and the scheme is undone
  void solve_step(State& state);
  /// Second part of advance(), not after a rejected step: makes the solved step the one that the next begins with.
  virtual void finish_step(const State& state);

  void keep(RestartArchive& archive) override;

 protected:
  /// The last pass of a stage that succeeded.
  struct GoodPass {
    bool found = false;
    std::vector<double> x;
    Solution fields;
    double gap = 0;  ///< |r(x)|, mm
  };

  /// Whether passes go on until fluid and wall agree; else the first ends the step.
  virtual bool iterates() const { return true; }
  /// Order of the extrapolated start of steps where the case names none. Iterations are the fewer the closer they
  /// start.
  virtual int standard_order() const { return 2; }
  /// Called before the stages of a step.
  virtual void begin_step(const State& /*state*/) {}
  /// Called where the step fails or is rejected. Undoes what begin_step() and the functions below changed in the
  /// scheme's own data, as the run may repeat the step with another length.
  virtual void take_back() {}
  /// Before the first guess of a stage. \throws ConvergenceError where the scheme sees that it would fail
  virtual void begin_stage(const State& /*state*/, const StepData& /*data*/) {}
  /// After a pass. \throws ConvergenceError where it shows that the scheme fails
  virtual void judge_pass(const State& /*state*/, const StepData& /*data*/) {}
  /// The last pass ends the stage: what remains to be done to its fields.
  virtual void finish_stage(State& /*state*/, const StepData& /*data*/) {}
  /// The interface's displacement that a gap is relative to, mm, Euclidean norm over it.
  virtual double size_of(const Pass& pass) const;
  /// Remedy in the message of a step that fails in a pass without a solution.
  virtual std::string advice_without_answer() const {
    return "a smaller partitioned.relaxation or a smaller time.step";
  }

  /// How well the media are solved in the first pass of a stage. Called again where the stage begins anew.
  virtual PassAccuracy first_accuracy();
  /// How well they are solved in the next pass.
  /// \param accuracy  of the last pass; overwritten
  virtual void next_accuracy(PassAccuracy& accuracy);
  /// Whether the last pass ends the stage.
  virtual bool agrees(const State& state, const StepData& data, const GoodPass& good);
  /// Whether the passes stagnate, so that the stage should begin anew with another method.
  virtual bool leads_nowhere() const { return false; }
  /// Switches to another method for the rest of the run, here to another Robin coefficient. Called where passes
  /// stagnate, and after `most_failures` passes without a solution. \returns its name for the log; empty: there is none
  /// left
  virtual std::string another_way();
  /// How far the last pass is from what is demanded, for the message of a failure.
  virtual std::string distance_from_demand() const;
  /// Whether a pass that agrees is taken as far as the final tolerance of the sub-problems.
  virtual bool refines() const { return true; }
  /// Estimated error of the accepted pass, relative to what the step changes: with rho the ratio of its residual to
  /// that of the pass before, rho / (1 - rho) times the change of the fields since, as in NewtonReport::error. After a
  /// quasi-Newton correction rho is at most 0.5. Without a pass before, or where its residual was smaller: the relative
  /// residuals of the interface times the wall's displacement and both pressures.
  virtual double estimated_error(const State& state, const StepData& data, const GoodPass& good) const;
  /// Change of fluid and wall since `good`, relative to what the step changes (relative_to_step()).
  double change_since(const State& state, const StepData& data, const GoodPass& good) const;

  /// Replaces the passes and their accelerator; the cost of the step so far is kept.
  void go_on_by(std::unique_ptr<CouplingPass<n>> problem, std::unique_ptr<Accelerator> accelerator);

  Scene<n>& scene() const { return scene_; }
  const InterfaceSpace& space() const { return space_; }
  CouplingPass<n>& problem() const { return *problem_; }
  const CouplingScheme& scheme() const { return scheme_; }
  CouplingReport& coupling() { return coupling_; }
  const CouplingReport& coupling() const { return coupling_; }
  int passes() const { return passes_; }
  /// Order of the extrapolated start.
  int first_order() const { return predictor_.value_or(standard_order()); }
  /// Whether the load has jumped before the step, or nothing was before it.
  bool after_jump() const { return after_jump_; }
  /// For a scheme that goes by after_jump(), which a restart must know.
  void keep_jump(RestartArchive& archive);
  void add_choice(StepperChoice choice) { choices_.push_back(std::move(choice)); }

 private:
  static constexpr int most_retreats = 10;        ///< failed passes of one step
  static constexpr int most_failures = 3;         ///< of them in a stage, before another_way() is asked
  static constexpr double retreat_factor = 0.25;  ///< of the way from the last good iterate, after a failed pass
  /// Relative interface residual beyond which the wall is linearised: there d~ lies so far off, a hundred times the
  /// error of d, that its nonlinearity would only mislead the accelerator.
  static constexpr double far = 0.8;
  /// Ratio of two periods of the interface's kinematics up to which differences of passes serve as they are.
  static constexpr double likeness = 1.2;
  /// Of the wall's thickness: how small motions of a wall under prestress still have a relative error, each component's
  /// root mean square. Below that they are compared with this.
  static constexpr double smallest_motion = 1e-5;

  /// Solves a step, or one stage of it; leaves its solution in state.now.
  void advance_stage(State& state, StepData& data);

  /// The first guess x of a stage; the accelerator and the monitors begin anew.
  std::vector<double> start_stage(State& state, StepData& data);
  /// Tells the accelerator where the period of the interface kinematics has changed by more than `likeness`, as r(x) is
  /// then another function; logs what a gap means as a pressure.
  void note_period(double period);

  /// A pass, measured. One that agrees is taken as far as the sub-problems' final tolerance. \throws PassFailure
  Pass measured_pass(const std::vector<double>& x, const PassAccuracy& accuracy);
  void measure(const Pass& pass);
  void log_pass();
  /// The accelerator's next x, and how well its pass is to be solved.
  void correct(const Pass& pass, std::vector<double>& x, PassAccuracy& accuracy);

  [[noreturn]] void give_up(const State& state, const StepData& data, const char* what) const;

  /// After a pass without a solution: goes back to the last good iterate and a part of the way again. Without a good
  /// iterate the stage starts from the last time level, and where it did so already, with a stiffer fluid interface.
  /// \throws ConvergenceError after `most_retreats`, or where none of this is possible
  void retreat(const PassFailure& failure, State& state, StepData& data, std::vector<double>& x, const GoodPass& good);

  void accept(State& state, const StepData& data, const std::vector<double>& x, const Pass& pass);

  Scene<n>& scene_;
  State spare_;  ///< storage
  const Loads& loads_;
  PartitionedData options_;
  Agreement agreement_;
  std::optional<int> predictor_;  ///< order of the extrapolated start that the case asks for
  std::vector<StepperChoice> choices_;
  const CouplingScheme& scheme_;
  InterfaceSpace space_;
  std::vector<double> fluid_volumes_, wall_volumes_;  ///< of the nodes, mm^3
  std::unique_ptr<Accelerator> accelerator_;
  std::unique_ptr<CouplingPass<n>> problem_;
  CouplingReport coupling_;
  DivergenceMonitor monitor_;  ///< of the passes of the stage in progress
  bool after_jump_ = true;     ///< the load has jumped before the step, or nothing was before it
  bool ends_at_jump_ = false;  ///< of the step in progress
  int passes_ = 0;             ///< of the stage in progress
  int order_ = 0;              ///< of the extrapolated start
  double period_ = 0;          ///< ms, of the interface's kinematics that the accelerator knows; 0: none yet
  bool starts_far_ = true;     ///< the first guess of the last stage was far from its end
};

}  // namespace fsi
