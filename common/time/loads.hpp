#pragma once

#include <fmt/format.h>

#include <cstdlib>

#include "case/case.hpp"
#include "time/state.hpp"
#include "time/time_scheme.hpp"

namespace fsi {

/// The pressures of a case, step by step. A step's load is the mean of the table over it, so that the impulse does not
/// depend on the time step; a static load rises in equal steps to the table's last value.
class Loads {
 public:
  explicit Loads(const Case& setup) : setup_(setup) {}

  int steps() const { return setup_.time ? setup_.time->steps() : setup_.static_load->load_steps; }

  /// Time at the end of a step, ms; the fraction of the load in statics. To twelve digits: 3 * 0.1 is 0.3, as it is for
  /// a run that ends there, so that one that goes on from it has the same times.
  double time_of(int step) const {
    if (!setup_.time) return static_cast<double>(step) / steps();
    if (step == steps()) return setup_.time->end;
    return std::strtod(fmt::format("{:.12g}", step * setup_.time->step).c_str(), nullptr);
  }

  /// kPa, of a step: at the inlet, and on the inner face of a wall without fluid.
  double inlet_pressure(int step) const {
    return setup_.inlet ? setup_.inlet->mean(time_of(step - 1), time_of(step)) : 0.0;
  }
  double wall_pressure(int step) const {
    if (!setup_.load) return 0.0;
    return setup_.time ? setup_.load->mean(time_of(step - 1), time_of(step)) : time_of(step) * setup_.load->at_end();
  }

  /// Data of the step that follows the state's last one.
  StepData next(const State& state, const TimeScheme& scheme) const {
    StepData data;
    const int step = state.step + 1;
    data.time = time_of(step);
    data.inlet_pressure = inlet_pressure(step);
    data.wall_pressure = wall_pressure(step);
    data.acceleration_history = scheme.acceleration_history(state);
    return data;
  }

 private:
  const Case& setup_;
};

}  // namespace fsi
