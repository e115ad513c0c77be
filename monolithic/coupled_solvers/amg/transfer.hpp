#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "algebra/node_graph.hpp"

namespace fsi {

/// Boundary information of the nodes of one level.
struct NodeMarks {
  std::vector<char> prescribed;  ///< the node's vector part is prescribed: it takes no coarse correction
  std::vector<char> interface;   ///< group 1: interpolates from coarse nodes of group 1 only

  NodeMarks() = default;
  explicit NodeMarks(int nodes) : prescribed(nodes, 0), interface(nodes, 0) {}
  int nodes() const { return static_cast<int>(prescribed.size()); }
};

/// Interpolation between two levels, one weight per (fine node, coarse node): each component of a node is interpolated
/// alone, so that velocities, displacements and pressures never mix. The vector part of a prescribed fine node is not
/// interpolated (its rows of P are zero), its scalar part is. Restriction is the transpose.
struct NodeTransfer {
  NodeGraph graph;              ///< rows fine nodes, columns coarse nodes
  std::vector<double> weights;  ///< in the order of the graph; rows sum to one unless smoothed
  int coarse_nodes = 0;
  std::vector<int> seeds;               ///< fine node at whose place each coarse node sits
  std::vector<char> fine_prescribed;    ///< per fine node
  std::vector<char> coarse_prescribed;  ///< per coarse node: every fine node it reaches is prescribed

  NodeGraph transposed;  ///< rows coarse nodes, columns fine nodes ascending
  std::vector<double> transposed_weights;

  int fine_nodes() const { return graph.rows(); }
  /// Fills in `transposed` and `coarse_prescribed` after graph, weights, coarse_nodes and fine_prescribed are set.
  void complete();
  std::size_t bytes() const;
};

/// fine += P coarse, `Entries` entries a node, the first `Vector` of which belong to the vector part.
/// \param scalar_factor  of the entries after the vector part
template <int Entries, int Vector>
void prolongate_add(const NodeTransfer& t, const std::vector<double>& coarse, std::vector<double>& fine,
                    double scalar_factor = 1) {
#pragma omp parallel for schedule(static) if (t.fine_nodes() > 10000)
  for (int i = 0; i < t.fine_nodes(); ++i) {
    double sum[Entries] = {};
    for (int at = t.graph.offsets[i]; at < t.graph.offsets[i + 1]; ++at) {
      const double* from = coarse.data() + static_cast<std::size_t>(t.graph.columns[at]) * Entries;
      for (int k = 0; k < Entries; ++k) sum[k] += t.weights[at] * from[k];
    }
    double* to = fine.data() + static_cast<std::size_t>(i) * Entries;
    if (!t.fine_prescribed[i])
      for (int k = 0; k < Vector; ++k) to[k] += sum[k];
    for (int k = Vector; k < Entries; ++k) to[k] += scalar_factor * sum[k];
  }
}

/// coarse = P^T fine.
template <int Entries, int Vector>
void restrict_to(const NodeTransfer& t, const std::vector<double>& fine, std::vector<double>& coarse) {
#pragma omp parallel for schedule(static) if (t.fine_nodes() > 10000)
  for (int c = 0; c < t.coarse_nodes; ++c) {
    double sum[Entries] = {};
    for (int at = t.transposed.offsets[c]; at < t.transposed.offsets[c + 1]; ++at) {
      const int i = t.transposed.columns[at];
      const double* from = fine.data() + static_cast<std::size_t>(i) * Entries;
      for (int k = t.fine_prescribed[i] ? Vector : 0; k < Entries; ++k) sum[k] += t.transposed_weights[at] * from[k];
    }
    double* to = coarse.data() + static_cast<std::size_t>(c) * Entries;
    for (int k = 0; k < Entries; ++k) to[k] = sum[k];
  }
}

}  // namespace fsi
