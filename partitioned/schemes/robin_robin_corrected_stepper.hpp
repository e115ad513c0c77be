#pragma once

#include <memory>

#include "partitioned/interface/robin_robin_corrected.hpp"
#include "partitioned/schemes/predictor_stepper.hpp"
#include "partitioned/schemes/robin_robin_stepper.hpp"

namespace fsi {

/// Robin-Robin with data that another march of it, beside this one, has corrected (interface/robin_robin_corrected.hpp).
template <int n>
class RobinRobinCorrectedStepper : public RobinRobinStepper<n> {
  using Base = RobinRobinStepper<n>;

 public:
  /// \throws InputError as RobinRobinStepper, and for generalised-alpha
  RobinRobinCorrectedStepper(Scene<n>& scene, const Loads& loads, const Case& setup, const CouplingScheme& scheme);

  void finish_step(const State& state) override;
  void keep(RestartArchive& archive) override;

 private:
  RobinRobinCorrectedStepper(Scene<n>& scene, const Loads& loads, const Case& setup, const CouplingScheme& scheme,
                             std::unique_ptr<RobinRobinCorrected<n>> problem);
  void begin_step(const State& state) override;

  RobinRobinCorrected<n>& corrected_;  ///< the problem
  PredictorStepper<n> prediction_;
};

}  // namespace fsi
