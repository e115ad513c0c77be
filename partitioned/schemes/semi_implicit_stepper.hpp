#pragma once

#include <string>

#include "partitioned/schemes/iterating_steppers.hpp"

namespace fsi {

/// Robin-Neumann iterations on a domain of the fluid that is extrapolated once a step (interface/semi_implicit.hpp).
template <int n>
class SemiImplicitStepper : public RobinNeumannStepper<n> {
  using Base = RobinNeumannStepper<n>;

 public:
  /// \throws InputError of a static case, which has nothing to extrapolate in
  SemiImplicitStepper(Scene<n>& scene, const Loads& loads, const Case& setup, const CouplingScheme& scheme);

  /// By how much the domain has missed the wall, where that is not small.
  std::string unchecked() const override;
  void keep(RestartArchive& archive) override;

 private:
  /// Part of the vessel's radius up to which the fluid's domain may miss the wall (docs/coupling.md).
  static constexpr double small = 0.005;

  void begin_step(const State&) override { before_ = gap_; }
  void take_back() override { gap_ = before_; }
  void finish_stage(State& state, const StepData& data) override;

  double gap_ = 0, before_ = 0;  ///< mm, largest of the steps; before the one in progress
};

}  // namespace fsi
