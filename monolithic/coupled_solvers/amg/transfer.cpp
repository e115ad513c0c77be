#include "monolithic/coupled_solvers/amg/transfer.hpp"

namespace fsi {

void NodeTransfer::complete() {
  transposed.offsets.assign(coarse_nodes + 1, 0);
  for (int c : graph.columns) ++transposed.offsets[c + 1];
  for (int c = 0; c < coarse_nodes; ++c) transposed.offsets[c + 1] += transposed.offsets[c];
  transposed.columns.resize(graph.columns.size());
  transposed_weights.resize(graph.columns.size());
  std::vector<int> next(transposed.offsets.begin(), transposed.offsets.end() - 1);
  coarse_prescribed.assign(coarse_nodes, 1);
  for (int i = 0; i < fine_nodes(); ++i)
    for (int at = graph.offsets[i]; at < graph.offsets[i + 1]; ++at) {
      const int c = graph.columns[at];
      transposed.columns[next[c]] = i;
      transposed_weights[next[c]++] = weights[at];
      if (!fine_prescribed[i]) coarse_prescribed[c] = 0;
    }
}

std::size_t NodeTransfer::bytes() const {
  return (graph.offsets.size() + graph.columns.size() + transposed.offsets.size() + transposed.columns.size()) *
             sizeof(int) +
         (weights.size() + transposed_weights.size()) * sizeof(double) + fine_prescribed.size() +
         coarse_prescribed.size();
}

}  // namespace fsi
