#include "monolithic/coupled_solvers/amg/galerkin.hpp"

namespace fsi {

NodeGraph galerkin_graph(const NodeGraph& fine, const NodeTransfer& left, const NodeTransfer& right) {
  NodeGraph coarse;
  coarse.offsets.assign(1, 0);
  std::vector<int> seen(right.coarse_nodes, -1), row_columns;
  for (int row = 0; row < left.coarse_nodes; ++row) {
    row_columns.clear();
    for (int a = left.transposed.offsets[row]; a < left.transposed.offsets[row + 1]; ++a) {
      const int i = left.transposed.columns[a];
      for (int at = fine.offsets[i]; at < fine.offsets[i + 1]; ++at) {
        const int j = fine.columns[at];
        for (int b = right.graph.offsets[j]; b < right.graph.offsets[j + 1]; ++b) {
          const int column = right.graph.columns[b];
          if (seen[column] == row) continue;
          seen[column] = row;
          row_columns.push_back(column);
        }
      }
    }
    std::sort(row_columns.begin(), row_columns.end());
    coarse.columns.insert(coarse.columns.end(), row_columns.begin(), row_columns.end());
    coarse.offsets.push_back(static_cast<int>(coarse.columns.size()));
  }
  return coarse;
}

std::vector<int> transposed_positions(const NodeGraph& graph) {
  std::vector<int> next(graph.offsets.begin(), graph.offsets.end() - 1), positions(graph.blocks(), -1);
  // Rows ascend, so the transposed entries of each column are met in the order of that column's own row.
  for (int row = 0; row < graph.rows(); ++row)
    for (int at = graph.offsets[row]; at < graph.offsets[row + 1]; ++at) {
      const int column = graph.columns[at];
      positions[at] = graph.columns[next[column]] == row ? next[column]++ : graph.find(column, row);
    }
  return positions;
}

}  // namespace fsi
