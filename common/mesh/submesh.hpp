#pragma once

#include <cassert>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// The part of a mesh that one sub-problem lives on, with its own node numbers.
template <int Dim, int Order = 1>
struct Submesh {
  using Cell = typename SimplexMesh<Dim, Order>::Cell;
  using Facet = typename SimplexMesh<Dim, Order>::Facet;

  std::vector<Point> nodes;      ///< mm, per local node
  std::vector<int> mesh_node;    ///< per local node, its number in the whole mesh
  std::vector<int> local_node;   ///< per mesh node, its local number, -1 outside
  std::vector<Cell> cells;       ///< local node numbers
  std::vector<int> cell_region;  ///< per cell, region of the whole mesh

  int node_count() const { return static_cast<int>(nodes.size()); }
  /// The facet in local node numbers; all its nodes must lie in this part.
  Facet local(Facet facet) const {
    for (int& node : facet) {
      assert(node >= 0 && static_cast<std::size_t>(node) < local_node.size());
      node = local_node[node];
      assert(node >= 0 && "facet outside the submesh");
    }
    return facet;
  }
};

/// The cells whose region is listed, in the order of the mesh; local nodes keep the order of the mesh nodes.
template <int Dim, int Order>
Submesh<Dim, Order> submesh(const SimplexMesh<Dim, Order>& mesh, const std::vector<int>& regions) {
  assert(mesh.cell_region.size() == mesh.cells.size());
  Submesh<Dim, Order> part;
  std::vector<char> wanted(mesh.regions.size(), 0);
  for (int region : regions) {
    assert(region >= 0 && static_cast<std::size_t>(region) < wanted.size());
    wanted[region] = 1;
  }
  part.local_node.assign(mesh.nodes.size(), -1);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (wanted[mesh.cell_region[c]])
      for (int node : mesh.cells[c]) part.local_node[node] = 0;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (part.local_node[n] == 0) {
      part.local_node[n] = part.node_count();
      part.nodes.push_back(mesh.nodes[n]);
      part.mesh_node.push_back(static_cast<int>(n));
    }
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (wanted[mesh.cell_region[c]]) {
      auto cell = mesh.cells[c];
      for (int& node : cell) node = part.local_node[node];
      part.cells.push_back(cell);
      part.cell_region.push_back(mesh.cell_region[c]);
    }
  return part;
}

}  // namespace fsi
