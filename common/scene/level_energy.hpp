#pragma once

#include "scene/scene.hpp"
#include "time/level_energy.hpp"
#include "time/state.hpp"

namespace fsi {

/// Energies of the latest finished level, uJ; over the elements and nodes that this process counts.
/// \param of_fluid  false: the fluid's is left at zero, where others find it on their way (EnergyBalance::step_to)
template <int n>
LevelEnergy level_energy(const Scene<n>& scene, const State& state, bool of_fluid = true) {
  LevelEnergy energy;
  const Solution& level = state.before[0];
  if (scene.fluid && of_fluid) energy.fluid_kinetic = scene.fluid->kinetic_energy(level.mesh, level.fluid);
  if (scene.wall) {
    const WallEnergy wall =
        scene.wall->energy(level.wall, state.wall_velocity, state.last_balance().wall, level.branches);
    energy.wall_kinetic = wall.kinetic;
    energy.wall_isochoric = wall.isochoric;
    energy.wall_volumetric = wall.volumetric;
    energy.wall_branches = wall.branches;
  }
  return energy;
}

}  // namespace fsi
