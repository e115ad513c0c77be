#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene/state.hpp"

namespace fsi {

/// What one step took.
struct StepReport {
  int outer_iterations = 1;          ///< coupling iterations; 1 in a monolithic step
  int newton_iterations = 0;         ///< all of the step
  int linear_iterations = 0;         ///< Krylov iterations; 0 with direct solvers
  std::vector<std::string> history;  ///< convergence history, for the log
};

/// What a stepper keeps between steps besides the state, by name: numbers that a restart needs to go on bit for bit.
struct Memory {
  std::map<std::string, std::vector<double>> arrays;
  std::map<std::string, double> numbers;
};

/// One way to advance a scene by a time step. The two drivers differ in this.
class Stepper {
 public:
  virtual ~Stepper() = default;
  /// Solves the next step and makes it the latest level of the state.
  /// \throws ConvergenceError; the state's finished levels are then untouched
  virtual StepReport advance(State& state) = 0;
  /// Of the last step, also of one that failed.
  const StepReport& report() const { return report_; }
  virtual Memory memory() const = 0;
  virtual void recall(const Memory& memory) = 0;

 protected:
  StepReport report_;
};

}  // namespace fsi
