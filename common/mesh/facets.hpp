#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "mesh/mid_edge_nodes.hpp"
#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Local node numbers of a cell's facets, facet i opposite vertex i; vertices first, then mid-edge nodes. Normals point
/// out of a positively oriented cell.
template <int Dim, int Order>
struct OutwardFacets {
  static constexpr int count = Dim + 1;
  using Table = std::array<typename SimplexMesh<Dim, Order>::Facet, count>;

  static constexpr std::array<std::array<int, Dim>, count> vertices() {
    if constexpr (Dim == 3)
      return {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    else
      return {{{1, 2}, {2, 0}, {0, 1}}};
  }
  static constexpr Table make() {
    Table facets{};
    for (int i = 0; i < count; ++i) {
      const auto corners = vertices()[i];
      for (int k = 0; k < Dim; ++k) facets[i][k] = corners[k];
      if constexpr (Order == 2) {
        const auto& facet_edges = SimplexEdges<Dim - 1>::vertices;
        const auto& cell_edges = SimplexEdges<Dim>::vertices;
        for (std::size_t e = 0; e < facet_edges.size(); ++e) {
          const int a = corners[facet_edges[e][0]], b = corners[facet_edges[e][1]];
          for (std::size_t k = 0; k < cell_edges.size(); ++k)
            if ((cell_edges[k][0] == a && cell_edges[k][1] == b) || (cell_edges[k][0] == b && cell_edges[k][1] == a))
              facets[i][Dim + e] = Dim + 1 + static_cast<int>(k);
        }
      }
    }
    return facets;
  }
  static constexpr Table table = make();
};

/// The facets of a positively oriented cell, facet i opposite vertex i, normals pointing out of it.
template <int Dim, int Order>
typename OutwardFacets<Dim, Order>::Table outward_facets(const typename SimplexMesh<Dim, Order>::Cell& cell) {
  auto facets = OutwardFacets<Dim, Order>::table;
  for (auto& facet : facets)
    for (int& node : facet) node = cell[node];
  return facets;
}
/// The facets of a linear tetrahedron.
inline std::array<std::array<int, 3>, 4> outward_facets(const std::array<int, 4>& cell) {
  return outward_facets<3, 1>(cell);
}

/// Vertices of a facet in ascending order: the same for all orientations and orders of one facet.
template <int Dim>
using FacetKey = std::array<int, Dim>;

/// \param facet  vertices first. Its length does not tell the dimension: a quadratic edge has as many nodes as a linear
/// triangle.
template <int Dim = 3, std::size_t Nodes>
FacetKey<Dim> facet_key(const std::array<int, Nodes>& facet) {
  static_assert(Nodes == nodes_of_simplex(Dim - 1, 1) || Nodes == nodes_of_simplex(Dim - 1, 2));
  FacetKey<Dim> key;
  std::copy_n(facet.begin(), Dim, key.begin());
  std::sort(key.begin(), key.end());
  return key;
}

/// Hash of a FacetKey, for unordered containers.
struct FacetKeyHash {
  template <std::size_t Vertices>
  std::size_t operator()(const std::array<int, Vertices>& key) const {
    std::uint64_t h = 0;
    for (const int node : key) h = (h ^ static_cast<std::uint64_t>(node)) * 0x9E3779B97F4A7C15ull;
    return static_cast<std::size_t>(h ^ (h >> 29));
  }
};

}  // namespace fsi
