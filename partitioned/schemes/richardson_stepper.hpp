#pragma once

#include <optional>
#include <string>

#include "partitioned/interface/richardson.hpp"
#include "partitioned/schemes/explicit_stepper.hpp"

namespace fsi {

/// A step is one iteration of Richardson's method, preconditioned by a pass of Dirichlet-Neumann (interface/richardson.hpp):
/// loosely coupled, and stable under added mass for 0 < alpha < 2/(1 + G). alpha is partitioned.relaxation, or else
/// 1/(1 + G), G being the added mass over the wall's answer as ExplicitStepper measures it.
template <int n>
class RichardsonStepper : public ExplicitStepper<n> {
  using Base = ExplicitStepper<n>;

 public:
  RichardsonStepper(Scene<n>& scene, const Loads& loads, const Case& setup, const CouplingScheme& scheme);

  std::optional<CouplingMethod> coupling_method() const override;
  void keep(Memory& memory) override;

 private:
  /// Linear extrapolation has no accelerations: what alpha leaves of them would not be of the first order then.
  int standard_order() const override { return 2; }
  void begin_stage(const State& state, const StepData& data) override;
  void judge_pass(const State& state, const StepData& data) override;
  void finish_stage(State& state, const StepData& data) override;

  std::string file_;       ///< of the case
  bool named_;             ///< alpha, by the case
  Richardson<n>& passes_;  ///< the problem
};

}  // namespace fsi
