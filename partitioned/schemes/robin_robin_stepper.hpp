#pragma once

#include <memory>
#include <optional>
#include <string>

#include "partitioned/coupling_stepper.hpp"
#include "partitioned/interface/robin_robin.hpp"
#include "partitioned/schemes/splitting_error_monitor.hpp"

namespace fsi {

/// The loosely coupled Robin-Robin scheme (interface/robin_robin.hpp): a step is one pass, the wall and then the fluid.
/// The first step and each after a jump of the load are iterated: the rest that one pass leaves of the jump would
/// oscillate between fluid and wall for long, the faster the shorter the steps (docs/theory.md, section 10.5).
template <int n>
class RobinRobinStepper : public CouplingStepper<n> {
  using Base = CouplingStepper<n>;

 public:
  /// \throws InputError for a static case, and for a time scheme that needs iterations (require_scheme_for_one_pass())
  RobinRobinStepper(Scene<n>& scene, const Loads& loads, const Case& setup, const CouplingScheme& scheme);
  /// With this problem, unchecked.
  RobinRobinStepper(Scene<n>& scene, const Loads& loads, const Case& setup, const CouplingScheme& scheme,
                    std::unique_ptr<RobinRobin<n>> problem);

  /// For tests and for the scheme that corrects it.
  const RobinRobin<n>& robin_robin() const { return problem_; }

  std::optional<CouplingMethod> coupling_method() const override;
  std::string unchecked() const override { return march_.unchecked(); }
  void keep(RestartArchive& archive) override;

 protected:
  void begin_step(const State& state) override;
  void take_back() override { march_ = before_; }

 private:
  bool iterates() const override { return Base::after_jump(); }
  int standard_order() const override { return 1; }
  void finish_stage(State& state, const StepData& data) override;
  double size_of(const Pass& pass) const override;
  std::string advice_without_answer() const override { return Base::scheme().advice; }

  const RobinRobin<n>& problem_;
  SplittingErrorMonitor march_, before_;  ///< of the steps; before the one in progress
};

/// The same with data of the last step on both sides (interface/robin_robin_parallel.hpp).
template <int n>
class RobinRobinParallelStepper : public RobinRobinStepper<n> {
 public:
  /// \throws InputError as RobinRobinStepper, for time schemes other than "euler" and for time.predictor = 0
  RobinRobinParallelStepper(Scene<n>& scene, const Loads& loads, const Case& setup, const CouplingScheme& scheme);
};

}  // namespace fsi
