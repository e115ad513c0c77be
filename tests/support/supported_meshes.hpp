#pragma once

#include <algorithm>
#include <string>

#include "mesh/boundary.hpp"
#include "mesh/simplex_mesh.hpp"

namespace fsi::test {

/// Puts those facets of the boundary whose nodes all satisfy a predicate into a group of this name.
template <int Dim, int Order, class Predicate>
void name_boundary(SimplexMesh<Dim, Order>& mesh, const std::string& name, Predicate holds) {
  auto group = std::find_if(mesh.facet_groups.begin(), mesh.facet_groups.end(),
                            [&](const auto& known) { return known.name == name; });
  if (group == mesh.facet_groups.end()) group = mesh.facet_groups.insert(group, {name, {}});
  for (const auto& facet : boundary_facets(mesh))
    if (std::all_of(facet.nodes.begin(), facet.nodes.end(), [&](int node) { return holds(mesh.nodes[node]); }))
      group->facets.push_back(facet.nodes);
}

}  // namespace fsi::test
