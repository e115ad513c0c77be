#include "mesh/mesh_share.hpp"

#include <cstdint>

#include "base/sort_unique.hpp"
#include "mesh/for_each_mesh.hpp"
#include "parallel/even_stretch.hpp"
#include "parallel/graph_partition.hpp"

namespace fsi {

namespace {

/// Which nodes share a cell with those of a stretch, row by row, each node among its own neighbours; columns ascend.
template <class Mesh>
void nodes_around(const Mesh& mesh, const EvenStretch& stretch, std::vector<int>& offsets, std::vector<int>& columns) {
  const auto is_here = [&](int node) { return node >= stretch.first && node < stretch.last; };
  const auto nodes = static_cast<std::size_t>(stretch.count());
  std::vector<int> starts(nodes + 1, 0), cells_at;
  for (const auto& cell : mesh.cells)
    for (const int node : cell)
      if (is_here(node)) ++starts[node - stretch.first + 1];
  for (std::size_t a = 0; a < nodes; ++a) starts[a + 1] += starts[a];
  cells_at.resize(static_cast<std::size_t>(starts.back()));
  std::vector<int> next(starts.begin(), starts.end() - 1);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (const int node : mesh.cells[c])
      if (is_here(node)) cells_at[next[node - stretch.first]++] = static_cast<int>(c);
  offsets = {0};
  std::vector<int> row;
  const auto for_rows = [&](auto visit) {
    for (std::size_t a = 0; a < nodes; ++a) {
      row.clear();
      for (int at = starts[a]; at < starts[a + 1]; ++at)
        row.insert(row.end(), mesh.cells[cells_at[at]].begin(), mesh.cells[cells_at[at]].end());
      sort_unique(row);
      visit();
    }
  };
  for_rows([&] { offsets.push_back(offsets.back() + static_cast<int>(row.size())); });
  columns.reserve(
      static_cast<std::size_t>(offsets.back()));  // rows are found twice, so that they take no more than that
  for_rows([&] { columns.insert(columns.end(), row.begin(), row.end()); });
}

}  // namespace

template <int Dim, int Order>
MeshShare share_mesh(const SimplexMesh<Dim, Order>& mesh, const Communicator& processes) {
  MeshShare share;
  share.processes = &processes;
  {
    std::vector<int> offsets, columns, weights;
    nodes_around(mesh, EvenStretch(static_cast<std::int64_t>(mesh.nodes.size()), processes), offsets, columns);
    // The cost of a node grows with its row: with the elements around it, and the products with it.
    for (std::size_t a = 0; a + 1 < offsets.size(); ++a) weights.push_back(std::max(1, offsets[a + 1] - offsets[a]));
    share.owner = partition_of_graph(offsets, columns, weights, processes);
  }
  std::vector<std::vector<int>> sent(processes.size()), received(processes.size());
  std::vector<int> owners;
  for (const auto& cell : mesh.cells) {
    if (!share.touches(cell)) continue;
    share.held.insert(share.held.end(), cell.begin(), cell.end());
    owners.clear();
    for (const int node : cell) owners.push_back(share.owner[node]);
    sort_unique(owners);
    for (const int rank : owners) {
      if (rank == processes.rank()) continue;
      for (const int node : cell) {
        if (share.owns(node)) sent[rank].push_back(node);
        if (share.owner[node] == rank) received[rank].push_back(node);
      }
    }
  }
  sort_unique(share.held);
  for (int rank = 0; rank < processes.size(); ++rank) {
    sort_unique(sent[rank]);
    sort_unique(received[rank]);
    if (!sent[rank].empty() || !received[rank].empty())
      share.neighbours.push_back({rank, std::move(sent[rank]), std::move(received[rank])});
  }
  return share;
}

PartRestriction::PartRestriction(const PartNodes& whole, const MeshShare& mesh)
    : whole_(whole), mesh_(mesh), local_(whole.nodes.size(), -1) {
  auto share = std::make_shared<NodeShare>();
  share->processes = mesh.processes;
  share->whole_nodes = whole.node_count();
  for (int a = 0; a < whole.node_count(); ++a) {
    const int node = whole.mesh_node[a];
    if (!std::binary_search(mesh.held.begin(), mesh.held.end(), node)) continue;
    local_[a] = static_cast<int>(share->whole_node.size());
    share->whole_node.push_back(a);
    share->owned.push_back(mesh.owns(node) ? 1 : 0);
  }
  // A mesh node may have several nodes in the part, one after the other: copies of the layers that meet there.
  std::vector<std::vector<int>> of_mesh_node(mesh.held.size());
  for (std::size_t i = 0; i < share->whole_node.size(); ++i) {
    const int node = whole.mesh_node[share->whole_node[i]];
    const auto place = std::lower_bound(mesh.held.begin(), mesh.held.end(), node) - mesh.held.begin();
    of_mesh_node[place].push_back(static_cast<int>(i));
  }
  const auto here = [&](const std::vector<int>& mesh_nodes) {
    std::vector<int> nodes;
    for (const int node : mesh_nodes) {
      const auto place = std::lower_bound(mesh.held.begin(), mesh.held.end(), node) - mesh.held.begin();
      nodes.insert(nodes.end(), of_mesh_node[place].begin(), of_mesh_node[place].end());
    }
    return nodes;
  };
  std::vector<Exchange::Neighbour> neighbours;
  for (const auto& n : mesh.neighbours) neighbours.push_back({n.rank, here(n.sent), here(n.received)});
  share->exchange = Exchange(*mesh.processes, std::move(neighbours));
  share_ = std::move(share);
}

std::vector<int> PartRestriction::nodes(const std::vector<int>& whole) const {
  std::vector<int> here;
  for (const int node : whole)
    if (local_[node] >= 0) here.push_back(local_[node]);
  return here;
}

PartNodes PartRestriction::part_nodes() const {
  PartNodes here;
  here.share = share_;
  here.local_node.assign(mesh_.held.size(), -1);
  for (std::size_t i = 0; i < share_->whole_node.size(); ++i) {
    const int a = share_->whole_node[i];
    const auto place = std::lower_bound(mesh_.held.begin(), mesh_.held.end(), whole_.mesh_node[a]) - mesh_.held.begin();
    here.nodes.push_back(whole_.nodes[a]);
    here.mesh_node.push_back(static_cast<int>(place));
    if (here.local_node[place] < 0) here.local_node[place] = static_cast<int>(i);
    if (whole_.has_copies()) here.original.push_back(local_[whole_.original[a]]);
  }
  return here;
}

#define FSI_INSTANTIATE(dim, order) template MeshShare share_mesh(const SimplexMesh<dim, order>&, const Communicator&);
FSI_FOR_EACH_MESH(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
