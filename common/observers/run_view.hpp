#pragma once

#include <filesystem>
#include <vector>

#include "case/case.hpp"
#include "derived/derived_quantities.hpp"
#include "io/fields_writer.hpp"
#include "observers/grid_share.hpp"
#include "observers/observation.hpp"
#include "observers/observer.hpp"
#include "scene/loads.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// What observers are made from. All of it outlives them.
template <int n>
struct RunView {
  const Case& setup;
  const Scene<n>& scene;
  const Loads& loads;
  const Stepper& stepper;
  const State& state;  ///< the current one of the run
  double scene_time;   ///< ms, in which the scene swings; 0 in statics
  const ObservationPoints& points;
  DerivedQuantities<n>& derived;
  const std::vector<FieldGrid>& grids;        ///< of the media, without fields
  const std::vector<GridShare>& grid_shares;  ///< of these grids, where processes share them out; else empty
  std::filesystem::path folder;               ///< of results
  std::filesystem::path restarted_from;       ///< result folder that the run continues; empty: a new run
  Messages& messages;
};

/// Time of the last level in a run's tables and fields, ms: the last but one where pressures lag behind the levels.
template <int n>
double shown_until(const Scene<n>& scene, const State& state) {
  return scene.integrator->pressures_lag() ? state.times[1] : state.time;
}

}  // namespace fsi
