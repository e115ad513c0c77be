#pragma once

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "scene/scene.hpp"
#include "time/state.hpp"
#include "time/step_data.hpp"

namespace fsi {

/// Takes the solution of a step's last stage as TimeIntegrator::accept() does, unless the level that follows is none.
/// With schemes that solve at a time within the step its end is extrapolated: elements of the wall that are sound in
/// the solution can be folded there, and their energy is no number.
/// \throws ConvergenceError with step, time and field; the state is then as before
template <int n>
void accept_level(const Scene<n>& scene, const StepData& data, State& state) {
  State before = state;
  scene.integrator->accept(state, data);
  const char* fault = nullptr;
  const auto look_at = [&](double number, const char* field) {
    if (fault == nullptr && scene.processes().any(!std::isfinite(number))) fault = field;
  };
  const Solution& level = state.before[0];
  if (scene.fluid)
    look_at(scene.fluid->kinetic_energy(level.mesh, level.fluid), "the fluid's velocity, by its kinetic energy,");
  if (scene.wall) {
    const auto energy = scene.wall->energy(level.wall, state.wall_velocity, state.last_balance().wall);
    look_at(energy.kinetic, "the wall's velocity, by its kinetic energy,");
    look_at(energy.isochoric + energy.volumetric, "the wall's displacement, by its strain energy,");
  }
  if (fault == nullptr) return;
  const auto failure =
      fmt::format("step {} (to t = {:g} ms): {} is not finite at the step's end", before.step + 1, data.time, fault);
  state = std::move(before);
  throw ConvergenceError(failure, "a smaller time.step or load, and look for a parameter that is out of proportion");
}

}  // namespace fsi
