#pragma once

#include <vector>

namespace fsi {

/// Which nodes couple with which: the sparsity shared by all block matrices of one submesh. Columns ascend in a row.
struct NodeGraph {
  std::vector<int> offsets;  ///< rows + 1 entries
  std::vector<int> columns;

  int rows() const { return static_cast<int>(offsets.size()) - 1; }
  int blocks() const { return static_cast<int>(columns.size()); }
  /// Position of block (row, column); -1 when the nodes do not couple.
  int find(int row, int column) const;
};

/// The graph of nodes that share a cell.
/// \param nodes           number of nodes
/// \param cell_nodes      node numbers, `nodes_per_cell` for each cell in turn
NodeGraph graph_of_cells(int nodes, const std::vector<int>& cell_nodes, int nodes_per_cell);

}  // namespace fsi
