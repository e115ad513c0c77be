#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace fsi {

// Tolerances that all samplers share.
inline constexpr double barycentric_inside = -1e-9;  // barycentric coordinates this far below zero are rounding
inline constexpr double furthest_edges = 0.5;        // how far outside a point may lie, in longest edges

inline constexpr const char* sampling_remedy =
    "check structure.axis_origin and structure.axis_direction, and that the mesh is in mm";

/// Negative weights become zero, the rest is scaled to the sum 1.
template <std::size_t N>
std::array<double, N> clamped_weights(std::array<double, N> weights) {
  double sum = 0;
  for (double& w : weights) sum += w = std::max(w, 0.0);
  for (double& w : weights) w /= sum;
  return weights;
}

}  // namespace fsi
