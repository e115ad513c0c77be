#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "case/case.hpp"
#include "partitioned/agreement.hpp"
#include "partitioned/divergence.hpp"
#include "partitioned/interface_space.hpp"
#include "partitioned/loose_march.hpp"
#include "partitioned/one_pass_march.hpp"
#include "partitioned/scheme_choice.hpp"
#include "partitioned/schemes.hpp"
#include "scene/loads.hpp"
#include "scene/scene.hpp"
#include "time/stepper.hpp"

namespace fsi {

template <int n>
class InterfaceProblem;
template <int n>
class PredictionMarch;
template <int n>
class RobinRobin;
template <int n>
class RobinRobinCorrected;
struct Pass;
struct PassAccuracy;
class PassFailure;

/// Advances fluid and wall in turn: passes through the sub-problems from an extrapolated guess, accelerated by the
/// case's scheme, until they agree on the interface.
template <int n>
class CouplingStepper : public Stepper {
 public:
  CouplingStepper(Scene<n>& scene, const Loads& loads, const Case& setup);
  /// With another scheme than the case's, which must outlive this and is not checked.
  CouplingStepper(Scene<n>& scene, const Loads& loads, const Case& setup, const CouplingScheme& scheme);

  ~CouplingStepper() override;

  std::optional<CouplingMethod> coupling_method() const override;
  bool reports_coupling() const override { return true; }
  std::vector<StepperChoice> choices() const override { return choices_; }

  StepReport advance(State& state) override;
  /// advance() in two: the step is solved, unless the judge rejects it (report().rejected),
  void solve_step(State& state);
  /// and is the one that the next begins with.
  void finish_step(const State& state);
  /// Of a scheme of Robin-Robin, else null.
  const RobinRobin<n>* loose_problem() const { return loose_; }

  /// Without iterations a march fails because it is unstable, which smaller steps do not mend.
  bool can_retry() const override { return !scheme_.one_pass || scheme_.loose != Loose::no; }
  std::string unchecked() const override {
    if (scheme_.loose != Loose::no) return loose_march_.unchecked();
    if (scheme_.extrapolates_domain) return unchecked_domain();
    return scheme_.one_pass ? march_.unchecked() : std::string();
  }

  void keep(Memory& memory) override;

 protected:
  /// With passes of another kind than those the scheme's row tells of.
  CouplingStepper(Scene<n>& scene, const Loads& loads, const Case& setup, const CouplingScheme& scheme,
                  std::unique_ptr<InterfaceProblem<n>> problem);

  /// The last pass of a stage that succeeded.
  struct GoodPass {
    bool found = false;
    std::vector<double> x;
    Solution fields;
    double gap = 0;  ///< |r(x)|, mm
  };

  /// How well the media are solved in the first pass of a stage,
  virtual PassAccuracy first_accuracy();
  /// and in the one that follows the last.
  virtual void next_accuracy(PassAccuracy& accuracy);
  /// Whether the last pass ends the stage.
  virtual bool agrees(const State& state, const StepData& data, const GoodPass& good);
  /// Whether passes lead nowhere, so that the stage should begin anew in another way.
  virtual bool leads_nowhere() const { return false; }
  /// How far the last pass is from what is demanded, for the message of a failure.
  virtual std::string distance_from_demand() const;
  /// Whether a pass that agrees is taken as far as the final tolerance of the sub-problems.
  virtual bool refines() const { return true; }
  /// What the accepted pass lacks, relative to what the step changes: with rho the ratio of its residual and that of
  /// the pass before, rho / (1 - rho) times what the fields have changed since, as NewtonReport::error has it. Of a pass
  /// without one before, or with a larger residual, the interface's relative residuals, of displacement and pressures.
  virtual double estimated_error(const State& state, const StepData& data, const GoodPass& good) const;
  /// What fluid and wall differ by between the fields of that pass and now, relative to what the step changes.
  double change_since(const State& state, const StepData& data, const GoodPass& good) const;

  const CouplingReport& coupling() const { return coupling_; }
  int passes() const { return passes_; }
  /// Whether the load has jumped before the step, or nothing was before it.
  bool after_jump() const { return after_jump_; }
  void add_choice(StepperChoice choice) { choices_.push_back(std::move(choice)); }

 private:
  static constexpr int most_retreats = 10;        ///< failed passes of one step
  static constexpr int most_failures = 3;         ///< of them, before another coefficient is tried
  static constexpr double retreat_factor = 0.25;  ///< of the way from the last good iterate, after a failed pass
  /// Relative interface residual beyond which the wall is linearised: there d~ lies so far off, a hundred times the
  /// error of d, that its nonlinearity would only mislead the accelerator.
  static constexpr double far = 0.8;
  /// Ratio of two periods of the interface's kinematics up to which differences of passes serve as they are.
  static constexpr double likeness = 1.2;
  /// Of the wall's thickness: how small motions of a wall under prestress still have a relative error, each component's
  /// root mean square. Below that they are compared with this.
  static constexpr double smallest_motion = 1e-5;

  /// Iterations are the fewer the closer they start. Without them a step is its extrapolation, and the second order
  /// makes it unstable at three times the wall's mass (docs/coupling.md).
  int first_order() const { return predictor_.value_or(scheme_.one_pass ? 1 : 2); }

  void make_problem(Scene<n>& scene, const Loads& loads, const Case& setup);

  /// Solves a step, or one stage of it; leaves its solution in state.now.
  void advance_stage(State& state, StepData& data);

  /// The first guess x of a stage; the accelerator and the monitors begin anew.
  std::vector<double> start_stage(State& state, StepData& data);
  /// Tells the accelerator when the interface's displacements weigh otherwise than they did.
  void note_period(double period);

  /// A pass, measured. One that agrees is taken as far as the sub-problems' final tolerance. \throws PassFailure
  Pass measured_pass(const std::vector<double>& x, const PassAccuracy& accuracy);
  void measure(const Pass& pass);
  void log_pass();
  /// The accelerator's next x, and how well its pass is to be solved.
  void correct(const Pass& pass, std::vector<double>& x, PassAccuracy& accuracy);

  [[noreturn]] void give_up(const State& state, const StepData& data, const char* what) const;

  /// Before the first step of one pass. \throws ConvergenceError where it would be unstable
  void check_added_mass(const State& state, const StepData& data);

  /// After a pass without an answer: back to the last good iterate and a part of the way again; without one, back to
  /// the last time level. \throws ConvergenceError when that has been tried often enough
  void retreat(const PassFailure& failure, State& state, StepData& data, std::vector<double>& x, const GoodPass& good);

  void accept(const std::vector<double>& x, const Pass& pass);

  /// Part of the vessel's radius up to which the fluid's domain may miss the wall (docs/coupling.md).
  static constexpr double small_domain_gap = 0.005;
  std::string unchecked_domain() const;

  /// Whether the step is one pass. Robin-Robin schemes iterate where the load has jumped: else what one pass lacks of the
  /// jump swings between fluid and wall for long, the faster the shorter the steps (docs/theory.md, section 10.5).
  bool one_pass() const { return scheme_.one_pass && !(scheme_.loose != Loose::no && after_jump_); }

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
  std::unique_ptr<InterfaceProblem<n>> problem_;
  RobinRobin<n>* loose_ = nullptr;                  ///< the problem, of a Robin-Robin scheme
  RobinRobinCorrected<n>* corrected_ = nullptr;     ///< the problem, of that scheme
  std::unique_ptr<PredictionMarch<n>> prediction_;  ///< its prediction
  CouplingReport coupling_;
  DivergenceMonitor monitor_;  ///< of the step's passes
  OnePassMarch march_;         ///< of the steps, with one pass each
  LooseMarch loose_march_;     ///< of the steps of Robin-Robin schemes
  bool after_jump_ = true;     ///< the load has jumped before the step, or nothing was before it
  double domain_gap_ = 0;      ///< mm, largest of the steps
  bool ends_at_jump_ = false;  ///< of the step in progress
  int passes_ = 0;             ///< of the stage in progress
  int order_ = 0;              ///< of the extrapolated start
  double period_ = 0;          ///< ms, of the interface's kinematics that the accelerator knows; 0: none yet
  bool starts_far_ = true;     ///< the last step's first guess was far from its end
};

}  // namespace fsi
