#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// The two vertices of each edge of a simplex, in the order in which quadratic cells list the nodes in their middles
/// behind the vertices: VTK's order.
template <int Dim>
struct SimplexEdges;
template <>
struct SimplexEdges<1> {
  static constexpr std::array<std::array<int, 2>, 1> vertices{{{0, 1}}};
};
template <>
struct SimplexEdges<2> {
  static constexpr std::array<std::array<int, 2>, 3> vertices{{{0, 1}, {1, 2}, {2, 0}}};
};
template <>
struct SimplexEdges<3> {
  static constexpr std::array<std::array<int, 2>, 6> vertices{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
};

/// The mesh with a node in the middle of every edge, edges straight. Vertices keep their numbers; the new nodes follow
/// in the order in which the cells come to them. Facets of the named groups are edges or faces of cells.
template <int Dim>
SimplexMesh<Dim, 2> with_mid_edge_nodes(const SimplexMesh<Dim, 1>& mesh) {
  SimplexMesh<Dim, 2> quadratic;
  quadratic.nodes = mesh.nodes;
  quadratic.cell_region = mesh.cell_region;
  quadratic.regions = mesh.regions;

  std::map<std::pair<int, int>, int> middle_of;
  const auto middle = [&](int a, int b) {
    const auto [found, is_new] = middle_of.try_emplace(std::minmax(a, b), static_cast<int>(quadratic.nodes.size()));
    if (is_new) {
      Point x;
      for (int i = 0; i < 3; ++i) x[i] = 0.5 * (mesh.nodes[a][i] + mesh.nodes[b][i]);
      quadratic.nodes.push_back(x);
    }
    return found->second;
  };
  // Vertices, then the middles of the edges.
  const auto extend = [&](const auto& linear, const auto& edges, auto& to) {
    std::copy(linear.begin(), linear.end(), to.begin());
    auto next = to.begin() + static_cast<std::ptrdiff_t>(linear.size());
    for (const auto& [a, b] : edges) *next++ = middle(linear[a], linear[b]);
  };
  quadratic.cells.resize(mesh.cells.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    extend(mesh.cells[c], SimplexEdges<Dim>::vertices, quadratic.cells[c]);
  for (const auto& group : mesh.facet_groups) {
    quadratic.facet_groups.push_back({group.name, {}, group.astray});
    auto& facets = quadratic.facet_groups.back().facets;
    facets.resize(group.facets.size());
    for (std::size_t f = 0; f < group.facets.size(); ++f)
      extend(group.facets[f], SimplexEdges<Dim - 1>::vertices, facets[f]);
  }
  return quadratic;
}

/// The mesh of the vertices alone: quadratic cells and facets become straight ones between the same vertices. Nodes
/// that are no vertex of any cell are dropped, the others keep their order; cells, regions and groups stay as they are.
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

}  // namespace fsi
