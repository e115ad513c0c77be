#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "mesh/mid_edge_nodes.hpp"
#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// The simplex with its first two vertices exchanged, mid-edge nodes along: the same shape, the other orientation.
/// \tparam Dim  of the simplex
template <int Dim, std::size_t Nodes>
std::array<int, Nodes> reversed(const std::array<int, Nodes>& simplex) {
  static_assert(Nodes == nodes_of_simplex(Dim, 1) || Nodes == nodes_of_simplex(Dim, 2));
  auto result = simplex;
  std::swap(result[0], result[1]);
  if constexpr (Nodes == nodes_of_simplex(Dim, 2)) {
    const auto exchanged = [](int vertex) { return vertex < 2 ? 1 - vertex : vertex; };
    const auto& edges = SimplexEdges<Dim>::vertices;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const int a = exchanged(edges[e][0]), b = exchanged(edges[e][1]);
      for (std::size_t k = 0; k < edges.size(); ++k)
        if ((edges[k][0] == a && edges[k][1] == b) || (edges[k][0] == b && edges[k][1] == a))
          result[Dim + 1 + e] = simplex[Dim + 1 + k];
    }
  }
  return result;
}

/// A mesh and its image in the plane where coordinate `axis` is zero, as one conforming mesh. Nodes with that
/// coordinate exactly zero are shared; cells and nodes of the image follow those of the mesh. Facets in the plane lie
/// inside the new mesh: they are left out, and with them groups of nothing else.
template <int Dim, int Order>
SimplexMesh<Dim, Order> joined_with_mirror_image(const SimplexMesh<Dim, Order>& mesh, int axis) {
  SimplexMesh<Dim, Order> joined;
  joined.nodes = mesh.nodes;
  joined.regions = mesh.regions;
  std::vector<int> image(mesh.nodes.size());
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    image[i] = static_cast<int>(i);
    if (mesh.nodes[i][axis] == 0) continue;
    image[i] = static_cast<int>(joined.nodes.size());
    joined.nodes.push_back(mesh.nodes[i]);
    joined.nodes.back()[axis] = -mesh.nodes[i][axis];
  }
  const auto mirrored = [&](auto simplex) {
    for (int& node : simplex) node = image[node];
    return simplex;
  };

  joined.cells = mesh.cells;
  joined.cell_region = mesh.cell_region;
  for (const auto& cell : mesh.cells) joined.cells.push_back(reversed<Dim>(mirrored(cell)));
  joined.cell_region.insert(joined.cell_region.end(), mesh.cell_region.begin(), mesh.cell_region.end());
  for (const auto& group : mesh.facet_groups) {
    const auto in_plane = [&](const auto& facet) { return mirrored(facet) == facet; };
    typename SimplexMesh<Dim, Order>::FacetGroup both{group.name, {}};
    for (const auto& facet : group.facets)
      if (!in_plane(facet)) both.facets.push_back(facet);
    const auto own = both.facets.size();
    for (std::size_t f = 0; f < own; ++f) both.facets.push_back(reversed<Dim - 1>(mirrored(both.facets[f])));
    if (own > 0) joined.facet_groups.push_back(std::move(both));
  }
  return joined;
}

}  // namespace fsi
