#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "partitioned/interface/membrane.hpp"
#include "scene/scene.hpp"
#include "system/field_numbering.hpp"
#include "time/step_data.hpp"

namespace fsi {

/// What a gap between fluid and wall is worth as a pressure, relative to the force between them: Euclidean norms of nodal
/// forces, the gap's being Membrane::push_stiffness() times the nodes' areas.
/// \param numbering  of the wall; held components bear no force
/// \param gap        n numbers per interface node, mm
template <int n>
double relative_gap_pressure(const Scene<n>& scene, const Membrane& membrane, const Numbering& numbering,
                             const StepData& data, const std::vector<double>& gap) {
  using Mixed = MixedLayout<n>;
  std::vector<double> loads = data.interface_load;
  scene.wall_frames.template to_frames<Mixed>(loads);  // where some components are free, and others held
  std::array<double, 2> sums{};
  for (std::size_t i = 0; i < scene.owned_interface(); ++i)
    for (int k = 0; k < n; ++k) {
      const std::size_t entry = Mixed::vector(scene.interface[i].wall, k);
      const double lack = membrane.node_areas[i] * gap[i * n + k];
      const double load = numbering.wall_rows[entry].index < 0 ? 0.0 : loads[entry];
      sums[0] += lack * lack;
      sums[1] += load * load;
    }
  scene.processes().sum(sums.data(), sums.size());
  const auto [lacking, force] = sums;
  if (lacking == 0) return 0;
  if (!(force > 0)) return std::numeric_limits<double>::max();
  return membrane.push_stiffness(data.rates.acceleration_factor) * std::sqrt(lacking / force);
}

}  // namespace fsi
