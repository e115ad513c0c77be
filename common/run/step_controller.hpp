#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "scene/loads.hpp"
#include "scene/scene.hpp"
#include "time/error_estimate.hpp"
#include "time/step_size_controller.hpp"
#include "time/stepper.hpp"

namespace fsi {

/// \throws InputError for equal steps so short that rounding hides what changes in one. To be called by all processes.
template <int n>
void require_resolvable(const Case& setup, const Scene<n>& scene);

/// Attempts at steps since the start of the program.
struct Attempts {
  int rejected = 0;  ///< solved, but with too large an error
  int failed = 0;    ///< without solution
  int beyond = 0;    ///< accepted with too large an error: smaller ones are not allowed
  int checked = 0;   ///< load steps that were taken in two halves as well
};

/// Takes steps: as the case says or, if they are adaptive, as long as their estimated error allows. A step without
/// solution is repeated with a part of its length; equal steps return to their grid after it. Load steps of a static
/// wall are repeated likewise, also where two half steps lead to another state than the whole one (docs/theory.md,
/// section 4.9).
template <int n>
class StepController : private StepJudge {
 public:
  /// All of them must outlive this.
  /// \param say   gets a line for each attempt that came to nothing, for the log
  /// \param warn  gets what a user should know of steps that were taken; none: `say`
  StepController(const Case& setup, const Scene<n>& scene, Stepper& stepper, Loads& loads,
                 std::function<void(const std::string&)> say, std::function<void(const std::string&)> warn = {});
  StepController(const StepController&) = delete;
  StepController& operator=(const StepController&) = delete;
  ~StepController() override;

  /// Takes the state one step further. Iterations in the report are those of all attempts.
  /// \throws ConvergenceError when the step has no solution, nor its last part; the finished levels are untouched
  StepReport step(State& state);

  const Attempts& attempts() const { return attempts_; }
  /// Of the last step; nothing where steps are not adaptive.
  const std::optional<StepErrors>& errors() const { return errors_; }

  /// Adapts controller and error estimate to the scene's integrator, after it has been replaced. Forgets earlier steps;
  /// does nothing where steps are not adaptive.
  void keep_scheme();
  /// What adaptive steps know of those before, for a restart.
  void keep(RestartArchive& archive);

 private:
  bool accepts(const State& state, const StepData& data) override;
  /// Makes the next step smaller. \returns false when it may not be
  bool shrink(int step, int failures);
  /// A load step; where it may have left the states that the load leads through, also in two halves.
  /// \throws ConvergenceError, too, where these lead to another state or none; the finished levels are untouched
  StepReport load_step(State& state);
  /// Why a load step is looked at again, a clause; empty: it is not.
  std::string doubt_about(const State& before, const State& after, const StepReport& report) const;
  /// Whether two ends of a load step have the same stored energy. Then they differ by a motion that stores none, as
  /// rigid motions of a wall on soft springs, and are no two solution branches.
  bool have_same_energy(const State& before, const State& one, const State& other) const;

  const Case& setup_;
  const Scene<n>& scene_;
  Stepper& stepper_;
  Loads& loads_;
  std::function<void(const std::string&)> say_, warn_;
  Attempts attempts_;
  std::optional<StepSizeController> controller_;
  std::optional<ErrorEstimate<n>> estimate_;
  std::optional<StepErrors> errors_;
};

}  // namespace fsi
