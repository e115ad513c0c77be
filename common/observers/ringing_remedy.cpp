#include "observers/ringing_remedy.hpp"

#include <fmt/format.h>

namespace fsi {

namespace {

constexpr double comes_back = 2;  // times the largest error of a step: at most 1.5 observed (docs/evidence/evidence.md)
constexpr double tighter = 0.01;  // what to try, relative to the tolerance in use

std::string remedy_by_solver(const Ringing& ringing, const Case& setup) {
  const NewtonOptions& newton = setup.newton;
  if (!ringing.coupled && newton.error_tolerance > 0)
    return fmt::format("give newton.error_tolerance = {:.0e}", tighter * newton.error_tolerance);
  if (!ringing.coupled) return fmt::format("give newton.tolerance = {:.0e}", tighter * newton.tolerance);
  if (setup.partitioned.tolerance_of != ToleranceOf::pressure) return "give partitioned.tolerance_of = \"pressure\"";
  return fmt::format("give partitioned.tolerance = {:.0e}", tighter * setup.partitioned.gap_tolerance());
}

}  // namespace

bool solver_can_ring(const Ringing& ringing) {
  return ringing.amplitude <= comes_back * ringing.solver_error * ringing.largest_pressure;
}

std::string said_of(const Ringing& ringing, const Case& setup) {
  const std::string seen = fmt::format("the pressure alternates from step to step, by {:.3g} Pa at t = {:g} ms",
                                       1e3 * ringing.amplitude, ringing.time);
  const std::string scheme = "the time scheme does not damp what its steps cannot resolve";
  if (!solver_can_ring(ringing)) return fmt::format("{}: {}; {}", seen, scheme, ringing.by_scheme);
  return fmt::format(
      "{}: what the solver leaves of a step, {:.1g} times what that changes, can be the cause; {}, and if the pressure "
      "still alternates, {}: {}",
      seen, ringing.solver_error, remedy_by_solver(ringing, setup), scheme, ringing.by_scheme);
}

}  // namespace fsi
