#pragma once

#include <vector>

#include "algebra/block_matrix.hpp"
#include "case/multigrid_kinds.hpp"
#include "monolithic/coupled_solvers/amg/transfer.hpp"

namespace fsi {

struct CoarseningOptions {
  CoarseningKind kind = CoarseningKind::colouring;
  /// Nodes of group 0 may interpolate from coarse interface nodes. Not where interface rows are conditions u = given
  /// among momentum rows (the wall of the coupled system): restriction would add the two kinds of rows up.
  bool interior_from_interface = true;
  /// Prescribed nodes have a scalar part to interpolate. Otherwise (mesh motion) their rows of P are empty.
  bool scalar_part = true;
};

/// A coarse level of nodes.
struct Coarsening {
  NodeTransfer transfer;
  NodeMarks marks;                    ///< of the coarse nodes
  std::vector<int> coarse_interface;  ///< coarse node of each coarse interface node, in the order of the surface's own
};

/// The interface as both sides see it: pairs of interface nodes that couple in both graphs. Row k is the node
/// `first_nodes[k]` of the first graph and `second_nodes[k]` of the second.
NodeGraph interface_graph(const NodeGraph& first, const std::vector<int>& first_nodes, const NodeGraph& second,
                          const std::vector<int>& second_nodes);

/// Coarsens the interface once, for all volumes that share it.
/// \param prescribed  per interface node; seeds are free nodes where possible
NodeTransfer coarsen_interface(const NodeGraph& surface, const std::vector<char>& prescribed, CoarseningKind kind);

/// Coarsens a volume whose interface is coarsened already: its interface nodes get exactly the given weights, the
/// others their own coarse nodes.
/// \param strong           the nodes that a node may interpolate from; symmetric, diagonal entries are ignored
/// \param marks            prescribed nodes and interface nodes
/// \param interface_nodes  volume node of each row of `surface`
/// \param surface          result of coarsen_interface()
Coarsening extend_interface(const NodeGraph& strong, const NodeMarks& marks, const std::vector<int>& interface_nodes,
                            const NodeTransfer& surface, const CoarseningOptions& options);

/// Coarsens a volume on its own. Where it has an interface, that is coarsened first, on its own subgraph.
Coarsening coarsen(const NodeGraph& strong, const NodeMarks& marks, const CoarseningOptions& options);

/// The graph of strong couplings: |A_ij|^2 > threshold^2 |A_ii| |A_jj| with Frobenius norms of the vector parts, made
/// symmetric.
/// \param vector     the vector part is the leading `vector` x `vector` entries of a block
/// \param threshold  0 keeps all couplings
template <int Size>
NodeGraph strong_graph(const BlockMatrix<Size, Size>& a, int vector, double threshold);

/// Prolongation smoothing by one damped Jacobi step, P <- (I - omega D^-1 A_F) P; [Vanek1996]. A_F is A with its
/// couplings to interface nodes lumped on the diagonal, unless options.interior_from_interface. Rows of prescribed and
/// of interface nodes stay as they are. Components share their weights: A is averaged over its Numbers.
/// \param tentative  P before
template <int Numbers>
NodeTransfer smoothed(const BlockMatrix<1, Numbers>& a, const NodeMarks& marks, const NodeTransfer& tentative,
                      const CoarseningOptions& options, double omega);

/// Rows of a graph by colour; no two coupled rows share a colour.
struct RowColours {
  std::vector<int> offsets;  ///< colours + 1
  std::vector<int> rows;     ///< by colour, ascending within
  int colours() const { return static_cast<int>(offsets.size()) - 1; }
};
/// Colours the rows of a symmetric graph, greedily in row order.
RowColours colour_rows(const NodeGraph& graph);

}  // namespace fsi
