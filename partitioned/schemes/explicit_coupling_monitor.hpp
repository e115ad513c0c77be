#pragma once

#include <string>

#include "partitioned/coupling_scheme.hpp"
#include "partitioned/divergence.hpp"
#include "time/stepper.hpp"

namespace fsi {

/// Watches a march of one pass a step, which makes no claim that fluid and wall agree: one that has become unstable ends
/// here, long before an element is inverted, and so does one that lingers at its stability limit with a pressure that means
/// nothing.
class ExplicitCouplingMonitor {
 public:
  /// \param scheme        must outlive this
  /// \param velocity_gap  PartitionedData::velocity_gap
  ExplicitCouplingMonitor(const CouplingScheme& scheme, double velocity_gap)
      : scheme_(&scheme), velocity_gap_(velocity_gap) {}

  /// With an extrapolation of order p, steps that alternate grow where the added mass is more than 1/3^(p-1) of what the
  /// wall answers with, whatever the time scheme; with backward Euler and Newmark's beta = gamma = 1 from half of that on
  /// (docs/coupling.md). \param time  ms, of the first step's end. \throws ConvergenceError there
  void require_small(double added_mass, int order, double time) const;
  /// \param movement  of the wall in the step, mm. \throws ConvergenceError where the step goes wrong
  void check(int step, double time, const CouplingReport& pass, double movement);
  void finish(int step) { steps_ = step; }

  /// As Stepper::unchecked(): the monitor speaks after some steps only.
  std::string unchecked() const;
  void keep(RestartArchive& archive);

 private:
  [[noreturn]] void give_up(int step, double time, const std::string& what) const;

  const CouplingScheme* scheme_;
  AlternationMonitor alternation_;
  VelocityGapMonitor velocity_gap_;
  int steps_ = 0;  ///< finished, of the whole run
};

}  // namespace fsi
