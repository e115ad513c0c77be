#pragma once

#include <algorithm>
#include <vector>

#include "derived/recovery_patches.hpp"
#include "mesh/symmetry_planes.hpp"
#include "scene/boundary_conditions.hpp"

namespace fsi {

/// The planes of symmetry that touch cells of a part, and the axis of a body of revolution.
/// \param part   the whole part
/// \param cells  nodes of the cells, in the part's numbers
template <class Element>
std::vector<RecoveryMirror> recovery_mirrors(const MeshOf<Element>& mesh, const PartOf<Element>& part,
                                             const std::vector<int>& cells) {
  std::vector<RecoveryMirror> mirrors;
  std::vector<char> used(part.nodes.size(), 0);
  for (const int node : cells) used[node] = 1;
  const auto add = [&](const Point& normal, const std::vector<char>& on) {
    RecoveryMirror mirror{normal, {}};
    for (std::size_t a = 0; a < used.size(); ++a)
      if (used[a] && on[a]) mirror.nodes.push_back(static_cast<int>(a));
    if (!mirror.nodes.empty()) mirrors.push_back(std::move(mirror));
  };
  for (const auto& plane : symmetry_planes(mesh)) {
    FacetsOf<Element> of_part;
    for (const auto& facet : plane.group->facets)
      if (std::all_of(facet.begin(), facet.end(), [&](int node) { return part.local_node[node] >= 0; }))
        of_part.push_back(facet);
    add(plane.normal, nodes_on<Element>(part, of_part));
  }
  if constexpr (Element::axisymmetric) {
    std::vector<char> on_axis(part.nodes.size(), 0);
    for (std::size_t a = 0; a < on_axis.size(); ++a) on_axis[a] = part.nodes[a][0] == 0;
    add({1, 0, 0}, on_axis);
  }
  return mirrors;
}

}  // namespace fsi
