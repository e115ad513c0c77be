#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "mesh/submesh.hpp"
#include "parallel/communicator.hpp"
#include "parallel/node_share.hpp"

namespace fsi {

/// Which nodes of a whole mesh processes own, and which this one holds: those of the cells that touch one of its own.
/// So a node of the fluid-wall interface has one owner for both media. Every process has the whole of this, for as long
/// as it has the whole mesh: while it builds its part of the scene.
struct MeshShare {
  const Communicator* processes = nullptr;
  std::vector<int> owner;  ///< per node of the mesh
  std::vector<int> held;   ///< nodes that this process holds, ascending
  /// What is exchanged with each neighbouring process: numbers of mesh nodes, ascending.
  std::vector<Exchange::Neighbour> neighbours;

  bool owns(int node) const { return owner[node] == processes->rank(); }
  template <class Nodes>
  bool touches(const Nodes& nodes) const {
    return std::any_of(nodes.begin(), nodes.end(), [this](int node) { return owns(node); });
  }
};

/// Shares out the nodes of a mesh so that processes have about the same work and few cells touch nodes of several.
/// Collective.
template <int Dim, int Order>
MeshShare share_mesh(const SimplexMesh<Dim, Order>& mesh, const Communicator& processes);

/// Maps numbers of a medium's whole part of the mesh to those of the part of it that this process holds.
class PartRestriction {
 public:
  /// Both must outlive this.
  PartRestriction(const PartNodes& whole, const MeshShare& mesh);

  /// Per node here, its number in the whole part; ascending.
  const std::vector<int>& whole_nodes() const { return share_->whole_node; }
  /// The number here of a node of the whole part; -1: not here.
  int local(int whole_node) const { return local_[whole_node]; }
  bool owns_whole(int whole_node) const { return local_[whole_node] >= 0 && share_->owned[local_[whole_node]] != 0; }
  /// The process that owns it.
  int owner(int whole_node) const { return mesh_.owner[whole_.mesh_node[whole_node]]; }
  const NodeShare& share() const { return *share_; }

  /// A nodal array of the whole part, `entries` numbers a node, as far as its nodes are here. An empty one stays empty.
  template <class T>
  std::vector<T> field(const std::vector<T>& whole, int entries = 1) const {
    std::vector<T> here;
    if (whole.empty()) return here;
    here.reserve(share_->whole_node.size() * static_cast<std::size_t>(entries));
    for (const int node : share_->whole_node) {
      const auto first = whole.begin() + static_cast<std::ptrdiff_t>(node) * entries;
      here.insert(here.end(), first, first + entries);
    }
    return here;
  }
  /// Nodes of the whole part that are here, in numbers here, in their order.
  std::vector<int> nodes(const std::vector<int>& whole) const;

  /// The facets (cells, ...) of the whole part that touch a node of this process, in numbers here: those that
  /// contribute to rows of its nodes.
  template <class Facet>
  std::vector<Facet> facets(const std::vector<Facet>& whole) const {
    return those<Facet>(whole, [this](const Facet& facet) {
      return std::any_of(facet.begin(), facet.end(), [this](int node) { return owns_whole(node); });
    });
  }
  /// Those of them that sums count here.
  template <class Facet>
  std::vector<Facet> counted_facets(const std::vector<Facet>& whole) const {
    return those<Facet>(whole, [this](const Facet& facet) { return counts(facet); });
  }
  /// Whether sums count a cell or facet here: at one process, the owner of its node of least number.
  /// \param nodes  in numbers of the whole part
  template <class Nodes>
  bool counts(const Nodes& nodes) const {
    return owns_whole(*std::min_element(nodes.begin(), nodes.end()));
  }

  /// The part with the cells that touch a node of this process. \param cells  set to their numbers in the whole part
  template <int Dim, int Order>
  Submesh<Dim, Order> part(const Submesh<Dim, Order>& whole, std::vector<int>& cells) const {
    Submesh<Dim, Order> here;
    static_cast<PartNodes&>(here) = part_nodes();
    cells.clear();
    for (std::size_t c = 0; c < whole.cells.size(); ++c) {
      auto cell = whole.cells[c];
      if (std::none_of(cell.begin(), cell.end(), [this](int node) { return owns_whole(node); })) continue;
      here.counted.push_back(counts(cell) ? 1 : 0);
      for (int& node : cell) node = local_[node];
      here.cells.push_back(cell);
      here.cell_region.push_back(whole.cell_region[c]);
      cells.push_back(static_cast<int>(c));
    }
    return here;
  }

 private:
  template <class Facet, class Wanted>
  std::vector<Facet> those(const std::vector<Facet>& whole, Wanted wanted) const {
    std::vector<Facet> here;
    for (Facet facet : whole) {
      if (!wanted(facet)) continue;
      for (int& node : facet) node = local_[node];
      here.push_back(facet);
    }
    return here;
  }
  /// Nodes of the part here; `mesh_node` numbers the nodes held here of the whole mesh.
  PartNodes part_nodes() const;

  const PartNodes& whole_;
  const MeshShare& mesh_;
  std::vector<int> local_;
  std::shared_ptr<const NodeShare> share_;
};

}  // namespace fsi
