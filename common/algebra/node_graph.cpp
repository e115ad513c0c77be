#include "algebra/node_graph.hpp"

#include <algorithm>
#include <cstdint>

#include "algebra/entry_count.hpp"

namespace fsi {

int NodeGraph::find(int row, int column) const {
  const auto begin = columns.begin() + offsets[row], end = columns.begin() + offsets[row + 1];
  const auto at = std::lower_bound(begin, end, column);
  return at != end && *at == column ? static_cast<int>(at - columns.begin()) : -1;
}

NodeGraph graph_of_cells(int nodes, const std::vector<int>& cell_nodes, int nodes_per_cell) {
  const int cells = static_cast<int>(cell_nodes.size()) / nodes_per_cell;
  std::vector<int> start(nodes + 1, 0), cells_of_node(cell_nodes.size());
  for (int node : cell_nodes) ++start[node + 1];
  for (int n = 0; n < nodes; ++n) start[n + 1] += start[n];
  auto next = start;
  for (int c = 0; c < cells; ++c)
    for (int a = 0; a < nodes_per_cell; ++a) cells_of_node[next[cell_nodes[c * nodes_per_cell + a]]++] = c;

  NodeGraph graph;
  graph.offsets.assign(1, 0);
  std::vector<int> row;
  for (int n = 0; n < nodes; ++n) {
    row.clear();
    for (int k = start[n]; k < start[n + 1]; ++k)
      for (int a = 0; a < nodes_per_cell; ++a) row.push_back(cell_nodes[cells_of_node[k] * nodes_per_cell + a]);
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    graph.columns.insert(graph.columns.end(), row.begin(), row.end());
    graph.offsets.push_back(entry_count(static_cast<std::int64_t>(graph.columns.size())));
  }
  return graph;
}

}  // namespace fsi
