#pragma once

#include <functional>
#include <string>
#include <utility>

#include "scene/loads.hpp"
#include "system/system.hpp"
#include "time/stepper.hpp"

namespace fsi {

/// Lines of the paper's Table 3: iteration, increment, residual.
void append_history(const NewtonReport& report, std::vector<std::string>& lines, const std::string& indent = "");

/// The point that a system's Jacobian was made at, if there is one; recalling, the system is linearised there again.
/// \param prepare  called before that
template <int n>
void keep_linearisation(const std::string& name, System<n>& system, Memory& memory,
                        const std::function<void(const StepRates&)>& prepare = {});

/// Advances a whole scene at once by Newton's method: the monolithic method for fluid and wall, and the only one there
/// is for a scene with one of them.
template <int n>
class NewtonStepper : public Stepper {
 public:
  /// \param numbering  of the whole scene
  NewtonStepper(Scene<n>& scene, const Loads& loads, NewtonOptions options, Numbering numbering,
                const LinearSolverFactory<n>& make_solver = {});

  const System<n>& system() const { return system_; }

  StepReport advance(State& state) override;

  void keep(Memory& memory) override;

 private:
  std::string name_of_step(const State& state, const StepData& data) const;

  std::string remedy(const NewtonReport& failed) const;

  /// Solves the equations of a step, or of one stage of it; leaves their solution in state.now.
  void advance_stage(State& state, const StepData& data);

  /// \param predictor  order of the extrapolated start
  NewtonReport solve(State& state, const StepData& data, int predictor);

  Scene<n>& scene_;
  State spare_;  ///< storage
  const Loads& loads_;
  NewtonOptions options_;
  System<n> system_;
};

}  // namespace fsi
