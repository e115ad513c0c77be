#pragma once

#include <algorithm>
#include <cassert>
#include <memory>
#include <numeric>
#include <vector>

#include "mesh/simplex_mesh.hpp"
#include "parallel/node_share.hpp"

namespace fsi {

/// The nodes of a part of a mesh, which has node numbers of its own.
struct PartNodes {
  std::vector<Point> nodes;     ///< mm, per local node
  std::vector<int> mesh_node;   ///< per local node, its number in the whole mesh
  std::vector<int> local_node;  ///< per mesh node, its local number, -1 outside

  /// Per local node, the first local node of the same mesh node: another one where a node has copies
  /// (split_between_regions); empty: nowhere.
  std::vector<int> original;

  /// How the part is shared out among processes, this one having its nodes and copies of those around; null: it is
  /// whole here.
  std::shared_ptr<const NodeShare> share;

  int node_count() const { return static_cast<int>(nodes.size()); }
  bool owns(int node) const { return !share || share->owned[node] != 0; }
  const Communicator& processes() const { return share ? *share->processes : Communicator::alone(); }
  bool has_copies() const { return !original.empty(); }
  int original_of(int node) const { return original.empty() ? node : original[node]; }
  /// Gives the copies of a node what holds for the original.
  template <class T>
  void spread_to_copies(std::vector<T>& per_node) const {
    for (std::size_t a = 0; a < original.size(); ++a) per_node[a] = per_node[original[a]];
  }
};

/// The part of a mesh that one sub-problem lives on.
template <int Dim, int Order = 1>
struct Submesh : PartNodes {
  using Cell = typename SimplexMesh<Dim, Order>::Cell;
  using Facet = typename SimplexMesh<Dim, Order>::Facet;

  std::vector<Cell> cells;       ///< local node numbers
  std::vector<int> cell_region;  ///< per cell, region of the whole mesh
  /// Per cell: sums over cells count it at this process. Cells between processes are held by several, and counted by
  /// one. Empty: all are.
  std::vector<char> counted;

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

/// The numbers of all cells.
template <int Dim, int Order>
std::vector<int> all_cells(const Submesh<Dim, Order>& part) {
  std::vector<int> all(part.cells.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// The vertices of all cells, Dim + 1 numbers each.
template <int Dim, int Order>
std::vector<int> vertices_of_cells(const Submesh<Dim, Order>& part) {
  std::vector<int> vertices;
  vertices.reserve(part.cells.size() * (Dim + 1));
  for (const auto& cell : part.cells) vertices.insert(vertices.end(), cell.begin(), cell.begin() + Dim + 1);
  return vertices;
}

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

/// The part with vertices of its own for each of its regions: where regions meet, a vertex has a copy for each, so that
/// scalar fields may jump there. Copies stand beside the original, which keeps the place that `local_node` names;
/// mid-edge nodes carry no scalars and have none. Vector fields have one value at an original and its copies. The part
/// itself, when no two of its regions meet.
template <int Dim, int Order>
Submesh<Dim, Order> split_between_regions(const Submesh<Dim, Order>& part) {
  // Regions of each vertex, in the order in which the cells come.
  std::vector<std::vector<int>> regions(part.nodes.size());
  for (std::size_t c = 0; c < part.cells.size(); ++c)
    for (int a = 0; a <= Dim; ++a) {
      auto& of_node = regions[part.cells[c][a]];
      if (std::find(of_node.begin(), of_node.end(), part.cell_region[c]) == of_node.end())
        of_node.push_back(part.cell_region[c]);
    }
  Submesh<Dim, Order> split;
  split.local_node.assign(part.local_node.size(), -1);
  split.cell_region = part.cell_region;
  std::vector<int> first(part.nodes.size());
  for (std::size_t a = 0; a < part.nodes.size(); ++a) {
    std::sort(regions[a].begin(), regions[a].end());
    first[a] = split.node_count();
    split.local_node[part.mesh_node[a]] = first[a];
    for (std::size_t copy = 0; copy < std::max<std::size_t>(1, regions[a].size()); ++copy) {
      split.nodes.push_back(part.nodes[a]);
      split.mesh_node.push_back(part.mesh_node[a]);
      split.original.push_back(first[a]);
    }
  }
  split.cells.reserve(part.cells.size());
  for (std::size_t c = 0; c < part.cells.size(); ++c) {
    auto cell = part.cells[c];
    for (std::size_t a = 0; a < cell.size(); ++a) {
      const auto& of_node = regions[cell[a]];
      const auto place = std::find(of_node.begin(), of_node.end(), part.cell_region[c]) - of_node.begin();
      cell[a] = first[cell[a]] + (of_node.empty() ? 0 : static_cast<int>(place));
    }
    split.cells.push_back(cell);
  }
  if (split.node_count() == part.node_count()) split.original.clear();
  return split;
}

/// Replaces, in facets of the part's boundary, the originals by the copies that the cell behind each facet has.
template <int Dim, int Order>
void name_copies_of_cells(const Submesh<Dim, Order>& part, std::vector<typename Submesh<Dim, Order>::Facet>& facets) {
  if (!part.has_copies()) return;
  std::vector<std::vector<std::size_t>> facets_at(part.nodes.size());  // by the original of the first vertex
  for (std::size_t f = 0; f < facets.size(); ++f) facets_at[facets[f][0]].push_back(f);
  for (const auto& cell : part.cells)
    for (int a = 0; a <= Dim; ++a)
      for (std::size_t f : facets_at[part.original_of(cell[a])]) {
        auto facet = facets[f];
        const bool behind = std::all_of(facet.begin(), facet.end(), [&](int& node) {
          const auto its = std::find_if(cell.begin(), cell.end(),
                                        [&](int b) { return part.original_of(b) == part.original_of(node); });
          if (its != cell.end()) node = *its;
          return its != cell.end();
        });
        if (behind) facets[f] = facet;
      }
}

}  // namespace fsi
