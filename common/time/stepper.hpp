#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/finite.hpp"
#include "time/level_energy.hpp"
#include "time/restart_archive.hpp"
#include "time/state.hpp"
#include "time/step_data.hpp"
#include "wall/wall_deformation.hpp"

namespace fsi {

/// How fluid and wall came to agree in one step of a partitioned method: a row of coupling.csv.
struct CouplingReport {
  int failed_passes = 0;             ///< passes repeated closer to the last good iterate
  double relaxation = 0;             ///< last factor; 0 when the last correction was none
  int columns = 0;                   ///< differences that the last quasi-Newton or Krylov correction used
  double displacement_residual = 0;  ///< |d~ - d| / |d~| on the interface
  double displacement_gap = 0;       ///< |d~ - d|, mm
  double force_residual = 0;         ///< residual of the momentum balance there, relative to the force
  double pressure_residual = 0;      ///< the pressure that would close the gap, relative to that between fluid and wall
  double gap_pressure = 0;           ///< the same in kPa, root mean square over the interface
  double traction_gap = 0;           ///< kPa, alike: between the fluid's traction and what the wall was loaded with
  double domain_gap = 0;             ///< mm, alike: between the wall and the boundary of the fluid's domain
  int fluid_newton_iterations = 0, wall_newton_iterations = 0;
  int fluid_linear_iterations = 0, wall_linear_iterations = 0;
  double fluid_seconds = 0, wall_seconds = 0, mesh_seconds = 0, algebra_seconds = 0;
};

/// What one step took, and what it led to.
struct StepReport {
  int outer_iterations = 1;   ///< coupling iterations; 1 in a monolithic step
  int newton_iterations = 0;  ///< all of the step
  int linear_iterations = 0;  ///< Krylov iterations; 0 with direct solvers
  double solver_error = 0;    ///< estimated, what solving this step left (docs/evidence/evidence.md, "The solver")
  std::vector<std::string> history;  ///< convergence history, for the log
  std::optional<CouplingReport> coupling;
  std::vector<Balance> balances;       ///< where Stepper::keep_balances() asked for them
  LevelEnergy level;                   ///< of the new level, without the fluid's
  std::vector<LayerDeformation> wall;  ///< of that level, layer by layer; empty without a wall
  /// Newton's method did not go straight to the solution, which may lie on another branch than the start.
  bool strayed = false;
  bool rejected = false;  ///< the judge refused the solution: the state has not advanced
};

/// Looks at the solution of a step, in state.now, before it becomes a finished level.
class StepJudge {
 public:
  virtual ~StepJudge() = default;
  virtual bool accepts(const State& state, const StepData& data) = 0;
};

/// A setting of a stepper that depends on the scene where the case does not name it, and what was decided.
struct StepperChoice {
  std::string key;     ///< of the case
  std::string value;   ///< that holds
  std::string reason;  ///< a clause
};

/// How a method couples fluid and wall, for log and summary.
struct CouplingMethod {
  const char* kind;  ///< "monolithic", "block" or "interface"
  std::string does;  ///< a clause: what it does in a pass, and with what
};

/// Values of the block matrices of fluid and wall that a method solves with; null: it has none. For the work unit, the
/// seconds of a product with them.
struct MatrixValues {
  const std::vector<double>*fluid = nullptr, *wall = nullptr;
};

/// One way to advance a scene by a time step. The two drivers differ in this.
class Stepper {
 public:
  virtual ~Stepper() = default;
  /// Solves the next step and makes it the latest level of the state, unless the judge rejects it.
  /// \throws ConvergenceError; the state's finished levels are then untouched
  virtual StepReport advance(State& state) = 0;
  /// Whether reports of steps have their balances, for callers that look at what the equations did.
  void keep_balances(bool keep) { keep_balances_ = keep; }
  /// The judge of solutions from now on, not owned; null: none. A step that it refused, or that failed, can be taken
  /// again with another length.
  void judge_by(StepJudge* judge) { judge_ = judge; }
  /// Whether a step whose usual iteration fails is solved by a slower fallback, if there is one.
  void persist(bool persist) { persists_ = persist; }
  /// Drops what it keeps of earlier steps beyond the state, as after a failed step.
  virtual void forget() {}
  /// Whether a step that failed may succeed with a smaller length.
  virtual bool can_retry() const { return true; }
  /// Whether the steps' reports have a coupling part.
  virtual bool reports_coupling() const { return false; }
  /// What a method has not checked yet of the steps so far, a sentence for the user; empty: nothing.
  virtual std::string unchecked() const { return {}; }
  /// Of the last step, also of one that failed.
  const StepReport& report() const { return report_; }
  /// For log and summary.
  virtual std::vector<StepperChoice> choices() const { return {}; }
  /// How fluid and wall are coupled; empty where there is nothing to couple.
  virtual std::optional<CouplingMethod> coupling_method() const { return std::nullopt; }
  virtual MatrixValues matrix_values() const { return {}; }
  /// What a restart needs of earlier steps besides the state.
  virtual void keep(RestartArchive& archive) = 0;

 protected:
  /// Of a step whose last stage is solved. \throws ConvergenceError when the solution of a stage is not finite
  bool rejects(const State& state, const StepData& data) {
    const std::string step = "step " + std::to_string(state.step + 1);
    require_finite(state.now.mesh, step + ": the displacement of the fluid's mesh");
    require_finite(state.now.fluid, step + ": the fluid's velocity or pressure");
    require_finite(state.now.wall, step + ": the wall's displacement or pressure");
    report_.rejected = judge_ != nullptr && data.rates.last_stage && !judge_->accepts(state, data);
    return report_.rejected;
  }

  bool keep_balances_ = false, persists_ = false;
  StepReport report_;

 private:
  StepJudge* judge_ = nullptr;
};

}  // namespace fsi
