#pragma once

#include <array>
#include <string>
#include <vector>

#include "parallel/communicator.hpp"
#include "time/error_terms.hpp"
#include "time/restart_archive.hpp"
#include "time/state.hpp"
#include "time/step_data.hpp"

namespace fsi {

/// Errors of a step relative to the solution.
struct StepErrors {
  bool known = false;  ///< false: too few levels since the load last jumped
  double displacement = 0, velocity = 0, pressure = 0;

  double largest() const;
  std::string text() const;  ///< "displacement 1.2e-3, velocity 2e-3, pressure 5e-3"
};

/// Estimates the error of a step from divided differences of its solution and the finished levels, as Milne's device
/// does for steps of one length:
///   displacement, velocity: what the step adds by ErrorTerms, times `scene_time` / dt: what such steps add in one
///                           oscillation of the scene;
///   pressure:               constant dt^order times its derivative of that order, through the last balances: a
///                           pressure follows accelerations of the same step and accumulates no error.
/// Norms are means over the volume. Displacement and velocity are relative to their largest norm so far, pressure to a
/// recent one: its largest norm decays within `scene_time`.
/// \tparam n  components of a vector
template <int n>
class ErrorEstimate {
 public:
  /// \param fluid_volumes, wall_volumes  of the nodes (fem/function_space.hpp), mm^3; zero at those of other processes;
  ///                                     empty: no such medium
  /// \param scene_time                   ms
  /// \param processes                    that share the nodes, and find the same errors
  ErrorEstimate(std::vector<double> fluid_volumes, std::vector<double> wall_volumes, const ErrorTerms& terms,
                double scene_time, const Communicator& processes = Communicator::alone());

  /// Of the solution in state.now of a step's last stage, before it is accepted. By all processes together.
  StepErrors of(const State& state, const StepData& data);
  /// The step that of() last looked at was accepted.
  void accept(const StepData& data);

  /// For a restart.
  void keep(RestartArchive& archive);

 private:
  struct Norms {
    double displacement = 0, velocity = 0, pressure = 0;
  };
  /// Root of the mean over the volume of the squares of `value(i)`, summed over `count` entries of each node.
  template <class Value>
  double norm(const std::vector<double>& volumes, int entries, int first, int count, Value value) const;

  std::vector<double> fluid_volumes_, wall_volumes_;
  ErrorTerms terms_;
  double scene_time_;
  const Communicator* processes_;
  bool has_fluid_, has_wall_;  ///< some process
  int since_jump_ = 0;         ///< finished steps since the load last jumped
  Norms scale_;                ///< of the solution
  Norms last_;                 ///< of the step that of() looked at
};

extern template class ErrorEstimate<2>;
extern template class ErrorEstimate<3>;

}  // namespace fsi
