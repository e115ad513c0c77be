#pragma once

#include <string>
#include <vector>

#include "partitioned/coupling_stepper.hpp"

namespace fsi {

/// Interface iteration by passes that solve each medium inexactly (docs/theory.md, section 10.2a;
/// inexact_robin_neumann.hpp, regularised_iqn.hpp). A step is solved when its error is estimated to be a small part of
/// what the step changes, as in the monolithic driver: with rho the factor by which changes and gaps of the last passes
/// fall, rho / (1 - rho) of the last change remains. Where passes stagnate the stage begins anew with a softer Robin
/// condition; where these stagnate too, with passes that solve both media.
template <int n>
class InexactStepper : public CouplingStepper<n> {
  using Base = CouplingStepper<n>;

 public:
  /// \throws InputError where the wall stands in the fluid
  InexactStepper(Scene<n>& scene, const Loads& loads, const Case& setup, const CouplingScheme& scheme);

  std::optional<CouplingMethod> coupling_method() const override;
  void keep(RestartArchive& archive) override;

 private:
  using GoodPass = typename Base::GoodPass;

  PassAccuracy first_accuracy() override;
  void next_accuracy(PassAccuracy& accuracy) override;
  bool agrees(const State& state, const StepData& data, const GoodPass& good) override;
  bool refines() const override { return false; }
  bool leads_nowhere() const override;
  std::string another_way() override;
  void solve_media();
  std::string distance_from_demand() const override;
  double estimated_error(const State&, const StepData&, const GoodPass&) const override { return error_; }

  PartitionedData options_;
  double demand_;                       ///< tolerated error over what a step changes
  double force_tolerance_;              ///< PartitionedData::force_tolerance
  bool loaded_at_rest_;                 ///< displacements count from a loaded shape
  double error_ = 0;                    ///< estimated, of the last pass
  bool solves_ = false;                 ///< passes solve both media now, as in iqn-ils or robin-neumann-iqn
  std::vector<double> gaps_, changes_;  ///< of the passes of the stage in progress
};

}  // namespace fsi
