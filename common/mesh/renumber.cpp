#include "mesh/renumber.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <functional>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/bucket_sort.hpp"
#include "mesh/for_each_mesh.hpp"
#include "mesh/mid_edge_nodes.hpp"

namespace fsi {

namespace {

/// Vertices that share a cell, as compressed rows, ascending; rows of mid-edge nodes are empty.
struct MeshGraph {
  std::vector<int> start, neighbour;

  template <int Dim, int Order>
  explicit MeshGraph(const SimplexMesh<Dim, Order>& mesh) {
    std::vector<std::pair<int, int>> edges;
    edges.reserve(Dim * (Dim + 1) * mesh.cells.size());
    for (const auto& cell : mesh.cells)
      for (int i = 0; i <= Dim; ++i)
        for (int j = 0; j <= Dim; ++j)
          if (i != j) edges.emplace_back(cell[i], cell[j]);
    bucket_sort(
        edges, mesh.nodes.size(), [](const auto& edge) { return edge.first; }, std::less<>());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    start.assign(mesh.nodes.size() + 1, 0);
    neighbour.reserve(edges.size());
    for (const auto& [a, b] : edges) {
      ++start[a + 1];
      neighbour.push_back(b);
    }
    std::partial_sum(start.begin(), start.end(), start.begin());
  }
  int degree(int node) const { return start[node + 1] - start[node]; }
};

/// Breadth-first levels from `root` over nodes not yet `placed`. Leaves the visited nodes in `order`, level by level,
/// and returns the number of levels; `last_level` is where the last one starts. `seen` carries a stamp per sweep.
int levels_from(const MeshGraph& graph, int root, const std::vector<char>& placed, std::vector<int>& seen, int stamp,
                std::vector<int>& order, std::size_t& last_level) {
  order.assign(1, root);
  seen[root] = stamp;
  int levels = 0;
  for (std::size_t begin = 0; begin < order.size();) {
    last_level = begin;
    const std::size_t end = order.size();
    ++levels;
    for (std::size_t i = begin; i < end; ++i)
      for (int e = graph.start[order[i]]; e < graph.start[order[i] + 1]; ++e) {
        const int next = graph.neighbour[e];
        if (placed[next] || seen[next] == stamp) continue;
        seen[next] = stamp;
        order.push_back(next);
      }
    begin = end;
  }
  return levels;
}

/// The two vertices that each node is in the middle of; a vertex twice itself.
template <int Dim, int Order>
std::vector<std::array<int, 2>> edge_of_nodes(const SimplexMesh<Dim, Order>& mesh) {
  std::vector<std::array<int, 2>> ends(mesh.nodes.size());
  for (std::size_t n = 0; n < ends.size(); ++n) ends[n].fill(static_cast<int>(n));
  if constexpr (Order == 2)
    for (const auto& cell : mesh.cells)
      for (std::size_t e = 0; e < SimplexEdges<Dim>::vertices.size(); ++e) {
        const auto& [a, b] = SimplexEdges<Dim>::vertices[e];
        ends[cell[Dim + 1 + e]] = {cell[a], cell[b]};
      }
  return ends;
}

/// Puts the mid-edge nodes into an order of the vertices, each among those whose later vertex is the same.
void insert_mid_edge_nodes(const std::vector<std::array<int, 2>>& ends, std::vector<int>& order) {
  std::vector<int> rank(ends.size(), -1);
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = static_cast<int>(i);
  std::vector<std::array<int, 3>> keys;  // later end, earlier end, node
  keys.reserve(ends.size());
  for (std::size_t n = 0; n < ends.size(); ++n) {
    const auto [early, late] = std::minmax(rank[ends[n][0]], rank[ends[n][1]]);
    keys.push_back({late, early, static_cast<int>(n)});
  }
  std::sort(keys.begin(), keys.end());
  order.clear();
  for (const auto& key : keys) order.push_back(key[2]);
}

}  // namespace

template <int Dim, int Order>
Renumbering reverse_cuthill_mckee(const SimplexMesh<Dim, Order>& mesh) {
  constexpr int nodes = nodes_of_simplex(Dim, Order);
  const auto ends = edge_of_nodes(mesh);
  const MeshGraph graph(mesh);
  const int count = static_cast<int>(mesh.nodes.size());
  const auto lower_degree = [&](int a, int b) {
    return std::make_tuple(graph.degree(a), a) < std::make_tuple(graph.degree(b), b);
  };

  Renumbering result;
  auto& order = result.node_new_to_old;
  order.reserve(count);
  std::vector<char> placed(count, 0);
  std::vector<int> seen(count, -1), sweep;
  int stamp = 0;
  for (int first = 0; first < count; ++first) {
    if (placed[first] || ends[first][0] != first) continue;

    // Walk to the far end until the number of levels grows no more.
    int root = first;
    std::size_t last_level = 0;
    int levels = levels_from(graph, root, placed, seen, stamp++, sweep, last_level);
    for (;;) {
      const int candidate = *std::min_element(sweep.begin() + static_cast<long>(last_level), sweep.end(), lower_degree);
      const int reached = levels_from(graph, candidate, placed, seen, stamp++, sweep, last_level);
      if (reached <= levels) break;
      levels = reached;
      root = candidate;
    }

    std::size_t head = order.size();
    order.push_back(root);
    placed[root] = 1;
    for (; head < order.size(); ++head) {
      const std::size_t begin = order.size();
      for (int e = graph.start[order[head]]; e < graph.start[order[head] + 1]; ++e) {
        const int next = graph.neighbour[e];
        if (placed[next]) continue;
        placed[next] = 1;
        order.push_back(next);
      }
      std::sort(order.begin() + static_cast<long>(begin), order.end(), lower_degree);
    }
  }
  std::reverse(order.begin(), order.end());
  if constexpr (Order == 2) insert_mid_edge_nodes(ends, order);

  const auto old_to_new = inverse_permutation(order);
  std::vector<std::array<int, nodes + 1>> keys(mesh.cells.size());  // new nodes ascending, then old index
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    for (int i = 0; i < nodes; ++i) keys[c][i] = old_to_new[mesh.cells[c][i]];
    std::sort(keys[c].begin(), keys[c].begin() + nodes);
    keys[c][nodes] = static_cast<int>(c);
  }
  std::sort(keys.begin(), keys.end());
  result.cell_new_to_old.reserve(keys.size());
  for (const auto& key : keys) result.cell_new_to_old.push_back(key[nodes]);
  return result;
}

template <int Dim, int Order>
SimplexMesh<Dim, Order> renumbered(const SimplexMesh<Dim, Order>& mesh, const Renumbering& order) {
  assert(order.node_new_to_old.size() == mesh.nodes.size());
  assert(order.cell_new_to_old.size() == mesh.cells.size() && mesh.cell_region.size() == mesh.cells.size());
  const auto old_to_new = inverse_permutation(order.node_new_to_old);
  SimplexMesh<Dim, Order> result;
  result.regions = mesh.regions;
  result.nodes.reserve(mesh.nodes.size());
  for (const int old : order.node_new_to_old) result.nodes.push_back(mesh.nodes[old]);
  for (const int old : order.cell_new_to_old) {
    auto cell = mesh.cells[old];
    for (int& node : cell) node = old_to_new[node];
    result.cells.push_back(cell);
    result.cell_region.push_back(mesh.cell_region[old]);
  }
  result.facet_groups = mesh.facet_groups;
  for (auto& group : result.facet_groups)
    for (auto& facet : group.facets)
      for (int& node : facet) node = old_to_new[node];
  return result;
}

std::vector<int> inverse_permutation(const std::vector<int>& permutation) {
  std::vector<int> inverse(permutation.size(), -1);
  for (std::size_t i = 0; i < permutation.size(); ++i) {
    const int entry = permutation[i];
    assert(entry >= 0 && static_cast<std::size_t>(entry) < inverse.size());
    assert(inverse[entry] < 0 && "an entry of the permutation occurs twice");
    inverse[entry] = static_cast<int>(i);
  }
  return inverse;
}

template <int Dim, int Order>
int bandwidth(const SimplexMesh<Dim, Order>& mesh) {
  int widest = 0;
  for (const auto& cell : mesh.cells) {
    const auto [low, high] = std::minmax_element(cell.begin(), cell.end());
    widest = std::max(widest, *high - *low);
  }
  return widest;
}

#define INSTANTIATE(Dim, Order)                                                                    \
  template Renumbering reverse_cuthill_mckee(const SimplexMesh<Dim, Order>&);                      \
  template SimplexMesh<Dim, Order> renumbered(const SimplexMesh<Dim, Order>&, const Renumbering&); \
  template int bandwidth(const SimplexMesh<Dim, Order>&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE

}  // namespace fsi
