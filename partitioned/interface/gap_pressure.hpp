#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "linear/interface/field_numbering.hpp"
#include "partitioned/interface/membrane.hpp"
#include "scene/scene.hpp"
#include "time/step_data.hpp"

namespace fsi {

/// The pressure that would close a gap between fluid and wall, relative to the force between them: the ratio of
/// Euclidean norms of nodal forces, a node's force for the gap being Membrane::push_stiffness() times its area times
/// the gap. Collective.
/// \param numbering  of the wall; held components of the load are left out
/// \param data       its interface_load is the force
/// \param gap        n numbers per interface node, mm
/// \returns 0 without a gap, the largest number for a gap without a force
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

/// Root mean square of the traction of nodal forces, kPa: sqrt((sum over nodes of |force|^2 / area) / whole area).
/// Clamped nodes and held components are left out. Collective.
/// \param numbering  of the wall
/// \param forces     n numbers per interface node, kPa mm^2
template <int n>
double root_mean_traction(const Scene<n>& scene, const Membrane& membrane, const Numbering& numbering,
                          const std::vector<double>& forces) {
  std::array<double, 2> sums{};
  for (std::size_t i = 0; i < scene.owned_interface(); ++i) {
    const auto& node = scene.interface[i];
    const double area = membrane.node_areas[i];
    if (!(area > 0) || node.clamped) continue;
    sums[1] += area;
    Direction<n> force{};
    for (int k = 0; k < n; ++k) force[k] = forces[i * n + k];
    if (const auto* axes = scene.wall_frames.at(node.wall)) NodalFrames<n>::to_frame(*axes, force.data());
    for (int k = 0; k < n; ++k)
      if (numbering.wall_rows[MixedLayout<n>::vector(node.wall, k)].index >= 0) sums[0] += force[k] * force[k] / area;
  }
  scene.processes().sum(sums.data(), sums.size());
  return sums[1] > 0 ? std::sqrt(sums[0] / sums[1]) : 0.0;
}

/// The pressure that would close a gap, kPa: root mean square over the interface. Collective.
/// \param per_gap  pressure per gap, kPa/mm; 1 gives the gap itself, mm
/// \param gap      n numbers per interface node, mm
template <int n>
double mean_gap_pressure(const Scene<n>& scene, const Membrane& membrane, const Numbering& numbering, double per_gap,
                         const std::vector<double>& gap) {
  std::vector<double> forces = gap;
  for (std::size_t i = 0; i < forces.size(); ++i) forces[i] *= membrane.node_areas[i / n];
  return per_gap * root_mean_traction(scene, membrane, numbering, forces);
}

}  // namespace fsi
