#pragma once

#include <optional>
#include <vector>

#include "partitioned/block_newton/block_newton_problem.hpp"
#include "partitioned/coupling_scheme.hpp"
#include "partitioned/scheme_choice.hpp"
#include "system/newton_stepper.hpp"

namespace fsi {

/// Advances fluid and wall by Newton's method for both, its linear systems solved by passes between the two: coupling of
/// the kind "block", which needs the Jacobians of both media.
template <int n>
class BlockNewtonStepper : public NewtonStepperBase<n> {
 public:
  BlockNewtonStepper(Scene<n>& scene, const Loads& loads, const Case& setup, const CouplingScheme& scheme);

  std::optional<CouplingMethod> coupling_method() const override;
  bool reports_coupling() const override { return true; }
  std::vector<StepperChoice> choices() const override { return choices_; }
  MatrixValues matrix_values() const override {
    return {problem_.fluid().fluid_values(), problem_.wall().wall_values()};
  }
  StepReport advance(State& state) override;
  void keep(RestartArchive& archive) override { problem_.keep(archive); }

 private:
  NewtonProblem& equations(State& state, StepData& data) override;
  void finish_stage(const State& state, const StepData& data) override;

  RobinStiffness stiffness_;
  std::vector<StepperChoice> choices_;
  BlockNewtonProblem<n> problem_;
};

}  // namespace fsi
