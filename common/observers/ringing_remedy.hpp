#pragma once

#include <string>

#include "case/case.hpp"

namespace fsi {

/// A pressure that alternates from step to step, as RingingMonitor finds it.
struct Ringing {
  double amplitude = 0;         ///< kPa
  double time = 0;              ///< ms
  double largest_pressure = 0;  ///< kPa, of the run so far, at the places that are looked at
  double solver_error = 0;      ///< the largest of the run's steps so far (StepReport)
  bool coupled = false;         ///< the steps' error is that of a partitioned coupling
  std::string by_scheme;        ///< what the run's time scheme offers (TimeIntegrator::against_ringing)
};

/// Whether the solver can have left the sawtooth. What it leaves of a displacement comes back in the pressures of the
/// next steps, alternating (docs/theory.md, section 9.3): as large beside the run's largest pressure as the step's error.
bool solver_can_ring(const Ringing& ringing);

/// What to say of it, and what helps: the cause that can be it comes first.
std::string said_of(const Ringing& ringing, const Case& setup);

}  // namespace fsi
