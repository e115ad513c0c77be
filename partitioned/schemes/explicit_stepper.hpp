#pragma once

#include <optional>
#include <string>

#include "partitioned/schemes/explicit_coupling_monitor.hpp"
#include "partitioned/schemes/iterating_steppers.hpp"

namespace fsi {

/// A step is one pass of Dirichlet-Neumann (docs/theory.md, section 10.1): unstable where the fluid's added mass
/// exceeds the wall's inertia and stiffness within a step (docs/coupling.md).
template <int n>
class ExplicitStepper : public DirichletNeumannStepper<n> {
  using Base = DirichletNeumannStepper<n>;

 public:
  /// \throws InputError where one pass a step cannot serve
  ExplicitStepper(Scene<n>& scene, const Loads& loads, const Case& setup, const CouplingScheme& scheme);

  std::optional<CouplingMethod> coupling_method() const override;
  /// Without iterations a run fails because it is unstable, and smaller steps do not help.
  bool can_retry() const override { return false; }
  std::string unchecked() const override { return march_.unchecked(); }
  void finish_step(const State& state) override;
  void keep(RestartArchive& archive) override;

 private:
  /// Without iterations the fluid sees the extrapolated interface. With order 2 this is unstable from a third of the
  /// added mass on that order 1 bears (ExplicitCouplingMonitor::require_small()).
  int standard_order() const override { return 1; }
  void begin_stage(const State& state, const StepData& data) override;
  void judge_pass(const State& state, const StepData& data) override;
  void finish_stage(State& state, const StepData& data) override;
  bool iterates() const override { return false; }
  void begin_step(const State&) override { before_ = march_; }
  void take_back() override { march_ = before_; }
  std::string advice_without_answer() const override { return Base::scheme().advice; }

  ExplicitCouplingMonitor march_, before_;  ///< of the steps; before the one in progress
};

/// How a pass is named where a step is one.
CouplingMethod one_pass_a_step();

}  // namespace fsi
