#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "scene/scene.hpp"

namespace fsi {

/// Areas of the wall's boundary at rest, mm^2 (plane scenes: lengths, mm; axisymmetric scenes: areas over 2 pi): its
/// faces on the interface, and all others but those on planes of symmetry.
struct WettedSides {
  double wet = 0, dry = 0;

  /// A wall around the fluid has an outer face that is no smaller than the inner one; of a flag, a valve or a pillar
  /// that stands in the flow the fluid wets nearly everything.
  bool stands_in_the_fluid() const { return wet > dry; }
};

namespace wetted_sides {

/// Length or area of a facet with straight edges; in axisymmetric scenes of what it describes, over 2 pi.
template <int n>
double area(const std::array<Point, n>& at, bool axisymmetric) {
  Point u{}, v{};
  for (int k = 0; k < 3; ++k) {
    u[k] = at[1][k] - at[0][k];
    v[k] = at[n - 1][k] - at[0][k];
  }
  if constexpr (n == 2) {
    const double length = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    return axisymmetric ? 0.5 * (at[0][0] + at[1][0]) * length : length;
  } else {
    const double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
    return 0.5 * std::sqrt(x * x + y * y + z * z);
  }
}

/// Whether a facet lies in a plane across an axis.
template <int n>
bool is_across(const std::array<Point, n>& at, int axis) {
  constexpr double flat = 1e-6;  // of the facet
  double along = 0, extent = 0;
  for (const Point& x : at)
    for (int k = 0; k < 3; ++k) {
      const double off = std::abs(x[k] - at[0][k]);
      extent = std::max(extent, off);
      if (k == axis) along = std::max(along, off);
    }
  return along <= flat * extent;
}

}  // namespace wetted_sides

/// Collective: areas over all processes.
template <int n>
WettedSides wetted_sides_of(const Scene<n>& scene) {
  using Facet = std::array<int, n>;
  const PartNodes& part = scene.wall->nodes();
  const std::vector<int> vertices = scene.wall->cell_vertices();
  std::map<Facet, int> cells_at;  // facets by their vertices, ascending
  for (std::size_t cell = 0; cell < vertices.size(); cell += n + 1)
    for (int left_out = 0; left_out <= n; ++left_out) {
      Facet facet;
      for (int i = 0, j = 0; i <= n; ++i)
        if (i != left_out) facet[j++] = part.original_of(vertices[cell + i]);
      std::sort(facet.begin(), facet.end());
      ++cells_at[facet];
    }
  std::vector<char> wet(part.nodes.size(), 0);
  for (const InterfaceNode& node : scene.interface) wet[node.wall] = 1;
  const bool axisymmetric = n == 2 && scene.axes[1] == 2;
  WettedSides sides;
  for (const auto& [facet, cells] : cells_at) {
    // All cells at the nodes of this process are here; sums count a facet at the owner of its first node.
    const int first = *std::min_element(facet.begin(), facet.end(),
                                        [&part](int a, int b) { return part.mesh_node[a] < part.mesh_node[b]; });
    if (cells != 1 || !part.owns(first)) continue;
    const auto all = [&nodes = facet](const auto& holds) { return std::all_of(nodes.begin(), nodes.end(), holds); };
    std::array<Point, n> at;
    for (int i = 0; i < n; ++i) at[i] = part.nodes[facet[i]];
    // Where the component along its normal vanishes at all nodes, but not the others, the facet lies on a plane of
    // symmetry. An outer face that slides along nothing but its own plane is none.
    int vanishing = 0, component = 0;
    for (int k = 0; k < n; ++k)
      if (all([&](int a) { return scene.wall_conditions.fixes(a, k); })) {
        ++vanishing;
        component = k;
      }
    if (vanishing == 1 && wetted_sides::is_across<n>(at, scene.axes[component])) continue;
    (all([&](int a) { return wet[a] != 0; }) ? sides.wet : sides.dry) += wetted_sides::area<n>(at, axisymmetric);
  }
  const Communicator& processes = scene.processes();
  return {processes.sum(sides.wet), processes.sum(sides.dry)};
}

}  // namespace fsi
