#pragma once

#include <string>

#include "partitioned/coupling_scheme.hpp"
#include "partitioned/divergence.hpp"
#include "time/stepper.hpp"

namespace fsi {

/// Monitors the explicit coupling, one pass a step, which does not check that fluid and wall agree. It ends a run that
/// has become unstable, long before an element is inverted, and one at its stability limit, whose pressure is wrong.
class ExplicitCouplingMonitor {
 public:
  /// \param scheme        must outlive this
  /// \param velocity_gap  PartitionedData::velocity_gap
  ExplicitCouplingMonitor(const CouplingScheme& scheme, double velocity_gap)
      : scheme_(&scheme), velocity_gap_(velocity_gap) {}

  /// With an extrapolation of order p, alternating steps grow where the ratio of added_mass() exceeds 1/3^(p-1),
  /// whatever the time scheme; with backward Euler and Newmark's beta = gamma = 1 from half of that on
  /// (docs/coupling.md).
  /// \param time  end of the first step, ms
  /// \throws ConvergenceError where the ratio exceeds 1/3^(p-1)
  void require_small(double added_mass, int order, double time) const;
  /// Judges the pass of a step.
  /// \param step      number of the step in progress, from 1
  /// \param time      end of the step, ms
  /// \param movement  of the wall in the step, mm, Euclidean norm (CouplingPass::movement())
  /// \throws ConvergenceError where the run has become unstable, or fluid and wall have come apart
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
