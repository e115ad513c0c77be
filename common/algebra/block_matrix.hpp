#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "algebra/node_graph.hpp"

namespace fsi {

/// A sparse matrix of dense Rows x Columns blocks on a node graph: blocks row-major, in the order of the graph.
template <int Rows, int Columns>
struct BlockMatrix {
  static constexpr int rows = Rows, columns = Columns, block_size = Rows * Columns;

  std::shared_ptr<const NodeGraph> graph;
  std::vector<double> values;

  BlockMatrix() = default;
  explicit BlockMatrix(std::shared_ptr<const NodeGraph> on)
      : graph(std::move(on)), values(static_cast<std::size_t>(graph->blocks()) * block_size, 0.0) {}

  double* block(int position) { return values.data() + static_cast<std::size_t>(position) * block_size; }
  const double* block(int position) const { return values.data() + static_cast<std::size_t>(position) * block_size; }
  void set_zero() { std::fill(values.begin(), values.end(), 0.0); }
};

}  // namespace fsi
