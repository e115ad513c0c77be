#pragma once

#include <string>

#include "case/case.hpp"

namespace fsi {

/// A pressure that alternates from step to step, as RingingMonitor finds it.
struct Ringing {
  double amplitude = 0;         ///< kPa
  double time = 0;              ///< ms
  double largest_pressure = 0;  ///< kPa, of the run so far, where the monitor looks
  double solver_error = 0;      ///< the largest of the run's steps so far (StepReport)
  bool coupled = false;         ///< whether the steps' error is that of a partitioned coupling
  std::string by_scheme;        ///< the time scheme's remedy (TimeIntegrator::against_ringing)
};

/// Whether the solver's errors can be the cause. The error of a displacement comes back in the pressures of the next
/// steps, alternating (docs/theory.md, section 9.3): about the step's error times the run's largest pressure.
bool solver_can_ring(const Ringing& ringing);

/// Message with the remedies, the likelier cause first.
std::string said_of(const Ringing& ringing, const Case& setup);

}  // namespace fsi
