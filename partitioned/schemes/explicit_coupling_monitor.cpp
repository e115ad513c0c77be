#include "partitioned/schemes/explicit_coupling_monitor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace fsi {

void ExplicitCouplingMonitor::require_small(double added_mass, int order, double time) const {
  const double limit = std::pow(3, 1 - order);
  if (!(added_mass > limit)) return;
  give_up(
      1, time,
      fmt::format("is unstable: the fluid's added mass is {:.3g} times what the wall answers with, more than {:.3g}",
                  added_mass, limit));
}

void ExplicitCouplingMonitor::check(int step, double time, const CouplingReport& pass, double movement) {
  if (alternation_.alternates(pass.displacement_gap, pass.displacement_residual))
    give_up(step, time,
            fmt::format("is unstable: {} steps running the wall has missed the extrapolated displacement by more than "
                        "its own, and further each time (now {:.2e} times)",
                        alternation_.steps(), pass.displacement_residual));
  if (velocity_gap_.comes_apart(pass.displacement_gap, movement))
    give_up(step, time,
            fmt::format("does not hold fluid and wall together, and its pressure is wrong: {} steps running their "
                        "velocities on the interface differ by more than {:g} times the largest so far (now {:.2f} "
                        "times)",
                        velocity_gap_.steps(), velocity_gap_.bound(), velocity_gap_.last()));
}

void ExplicitCouplingMonitor::give_up(int step, double time, const std::string& what) const {
  throw ConvergenceError(fmt::format("step {} (to t = {:g} ms): the {} coupling {}", step, time, scheme_->name, what),
                         scheme_->advice);
}

std::string ExplicitCouplingMonitor::unchecked() const {
  const int apart = std::max(velocity_gap_.steps(), alternation_.steps());
  if (steps_ >= VelocityGapMonitor::most_steps && apart == 0) return {};
  const std::string seen = apart > 0 ? fmt::format("; in the last {} of them fluid and wall came apart", apart) : "";
  return fmt::format(
      "the {} coupling claims nothing of {} steps{}: whether fluid and wall hold together shows after {}; "
      "compare with partitioned.scheme = \"iqn-ils\"",
      scheme_->name, steps_, seen, VelocityGapMonitor::most_steps);
}

void ExplicitCouplingMonitor::keep(RestartArchive& archive) {
  // Where another scheme wrote the checkpoint, they are as in a new march.
  int alternating = alternation_.steps(), apart = velocity_gap_.steps();
  double gap = alternation_.last_gap(), movement = velocity_gap_.largest_movement();
  archive.count_if_there("steps", steps_);
  archive.count_if_there("alternating_steps", alternating);
  archive.number_if_there("last_gap", gap);
  archive.count_if_there("steps_apart", apart);
  archive.number_if_there("largest_movement", movement);
  if (!archive.step_changed()) alternation_.set(alternating, gap);
  velocity_gap_.set(apart, movement);
}

}  // namespace fsi
