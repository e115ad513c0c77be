#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "scene/level_energy.hpp"
#include "scene/scene.hpp"
#include "system/wall_check.hpp"
#include "time/state.hpp"
#include "time/step_data.hpp"
#include "time/stepper.hpp"
#include "time/time_text.hpp"

namespace fsi {

/// "step 3 (to t = 0.5 ms)", "load step 2 (to 0.4 of the load)"
template <int n>
std::string name_of_step(const Scene<n>& scene, int step, const StepData& data) {
  const bool is_static = scene.is_static();
  return fmt::format("{}step {} (to {})", is_static ? "load " : "", step, time_text(data.time, is_static));
}

/// Takes the solution of a step's last stage as TimeIntegrator::accept() does, unless the new level is not admissible.
/// With schemes that solve at a time within the step its end is extrapolated: elements of the wall that are sound in
/// the solution can be folded there, and their energy is NaN.
/// \param spare   storage, for the state as it was
/// \param report  gets the wall's energies and deformation of the new level
/// \throws ConvergenceError with step, time and field; the state is then as before
template <int n>
void accept_level(const Scene<n>& scene, const StepData& data, State& state, State& spare, StepReport& report) {
  const auto phase = scene.profile.phase("level check");
  spare = state;
  scene.integrator->accept(state, data);
  WallCheck check = check_wall(scene, state.before[0].wall);
  if (!check.fault.empty()) {
    const auto failure = fmt::format("{}: {}", name_of_step(scene, spare.step + 1, data), check.fault);
    std::swap(state, spare);
    throw ConvergenceError(failure, wall_check_remedy(scene));
  }
  report.wall = std::move(check.layers);
  const LevelEnergy level = report.level = level_energy(scene, state, false);
  std::array<double, 3> infinite{};
  for (const auto* field : {&state.before[0].mesh, &state.before[0].fluid})
    infinite[0] += !std::all_of(field->begin(), field->end(), [](double x) { return std::isfinite(x); });
  infinite[1] = !std::isfinite(level.wall_kinetic);
  infinite[2] = !std::isfinite(level.wall_isochoric + level.wall_volumetric);
  scene.processes().sum(infinite.data(), infinite.size());
  if (infinite == std::array<double, 3>{}) return;
  const char* fault = infinite[0] > 0   ? "the fluid's velocity, its pressure or the displacement of its mesh"
                      : infinite[1] > 0 ? "the wall's velocity, by its kinetic energy,"
                                        : "the wall's displacement, by its strain energy,";
  const auto failure =
      fmt::format("{}: {} is not finite at the step's end", name_of_step(scene, spare.step + 1, data), fault);
  std::swap(state, spare);
  throw ConvergenceError(failure, "a smaller time.step or load, and look for a parameter that is out of proportion");
}

}  // namespace fsi
