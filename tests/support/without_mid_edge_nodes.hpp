#pragma once

#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi::test {

/// The mesh of the vertices alone: quadratic cells and facets become straight ones between the same vertices. Nodes that
/// are no vertex of any cell are dropped, the others keep their order; cells, regions and groups stay as they are.
template <int Dim>
SimplexMesh<Dim, 1> without_mid_edge_nodes(const SimplexMesh<Dim, 2>& mesh) {
  SimplexMesh<Dim, 1> linear;
  linear.cell_region = mesh.cell_region;
  linear.regions = mesh.regions;

  std::vector<int> number(mesh.nodes.size(), -1);
  for (const auto& cell : mesh.cells)
    for (int i = 0; i <= Dim; ++i) number[cell[i]] = 0;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    if (number[n] < 0) continue;
    number[n] = static_cast<int>(linear.nodes.size());
    linear.nodes.push_back(mesh.nodes[n]);
  }
  for (const auto& cell : mesh.cells) {
    auto& vertices = linear.cells.emplace_back();
    for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i] = number[cell[i]];
  }
  for (const auto& group : mesh.facet_groups) {
    auto& facets = linear.facet_groups.emplace_back().facets;
    linear.facet_groups.back().name = group.name;
    for (const auto& facet : group.facets) {
      auto& vertices = facets.emplace_back();
      for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i] = number[facet[i]];
    }
  }
  return linear;
}

}  // namespace fsi::test
