#pragma once

#include <vector>

#include "fem/nodal_frames.hpp"
#include "mesh/mesh_share.hpp"
#include "scene/dirichlet_conditions.hpp"

namespace fsi {

/// Conditions of a medium's whole part, at the nodes that this process holds: own ones and ghosts.
template <int n>
DirichletConditions<n> restricted(const DirichletConditions<n>& whole, const PartRestriction& here) {
  std::vector<double> values(VectorLayout<n>::size(whole.node_count()), 0.0);
  whole.template impose<VectorLayout<n>>(values);
  DirichletConditions<n> conditions(static_cast<int>(here.whole_nodes().size()));
  for (std::size_t a = 0; a < here.whole_nodes().size(); ++a)
    for (int k = 0; k < n; ++k)
      if (const int node = here.whole_nodes()[a]; whole.fixes(node, k))
        conditions.fix(static_cast<int>(a), k, values[VectorLayout<n>::vector(node, k)]);
  return conditions;
}

template <int n>
NodalFrames<n> restricted(const NodalFrames<n>& whole, const PartRestriction& here) {
  NodalFrames<n> frames;
  for (const int node : whole.nodes())
    if (here.local(node) >= 0) frames.turn(here.local(node), *whole.at(node));
  return frames;
}

template <int n>
VanishingComponents<n> restricted(const VanishingComponents<n>& whole, const PartRestriction& here) {
  VanishingComponents<n> components;
  components.frames = restricted(whole.frames, here);
  for (const std::size_t entry : whole.entries) {
    const int node = here.local(static_cast<int>(entry) / n);
    if (node >= 0) components.entries.push_back(VectorLayout<n>::vector(node, static_cast<int>(entry) % n));
  }
  return components;
}

}  // namespace fsi
