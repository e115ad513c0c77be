#include "mesh_motion/motion_of_vertices.hpp"

#include <algorithm>
#include <array>

#include "fem/elements.hpp"
#include "mesh/mid_edge_nodes.hpp"

namespace fsi {

namespace {

/// w over the mean diagonal entry of a cell's vertices. So small that couplings of neighbouring vertices stay negative,
/// as multigrid expects of couplings along an edge.
constexpr double weight_over_diagonal = 0.5;

/// Calls visit(cell, node in the middle, end, other end), for edges of several cells once for each.
template <int Dim, class Visit>
void for_each_edge(const Submesh<Dim, 2>& part, Visit visit) {
  const auto& edges = SimplexEdges<Dim>::vertices;
  for (std::size_t c = 0; c < part.cells.size(); ++c)
    for (std::size_t e = 0; e < edges.size(); ++e)
      visit(c, part.cells[c][Dim + 1 + e], part.cells[c][edges[e][0]], part.cells[c][edges[e][1]]);
}

/// Of each vertex with those that share an edge, and of each node in the middle of an edge with its ends.
template <int Dim>
std::shared_ptr<const NodeGraph> graph_of_edges(const Submesh<Dim, 2>& part) {
  std::vector<int> edges;  // node in the middle, ends
  edges.reserve(part.cells.size() * 3 * SimplexEdges<Dim>::vertices.size());
  for_each_edge(part, [&](std::size_t, int middle, int a, int b) { edges.insert(edges.end(), {middle, a, b}); });
  return std::make_shared<NodeGraph>(graph_of_cells(part.node_count(), edges, 3));
}

}  // namespace

template <class Element>
MotionOfVertices<Element>::MotionOfVertices(const Part& part, const ElementPacks<Element>& packs,
                                            std::vector<double> stiffness)
    : part_(part), packs_(packs), graph_(graph_of_edges(part)), stiffness_(std::move(stiffness)) {}

template <class Element>
void MotionOfVertices<Element>::assemble(MeshMotionMatrix<n>& matrix) const {
  using OnVertices = typename Element::OnVertices;
  std::vector<std::array<int, OnVertices::nodes>> cells(part_.cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    std::copy_n(part_.cells[c].begin(), OnVertices::nodes, cells[c].begin());
  const ElementPacks<OnVertices> packs(part_.nodes, cells, all_cells(part_), *graph_);
  std::vector<double> diagonals(cells.size() * n);
  assemble_mesh_motion(packs, matrix, stiffness_, &diagonals);

  std::vector<double> weights(part_.nodes.size() * n, 0.0);
  std::vector<std::array<int, 2>> ends(part_.nodes.size(), {-1, -1});
  for_each_edge(part_, [&](std::size_t cell, int middle, int a, int b) {
    ends[middle] = {a, b};
    for (int k = 0; k < n; ++k)
      weights[static_cast<std::size_t>(middle) * n + k] += weight_over_diagonal * diagonals[cell * n + k];
  });
  constexpr double share[3] = {1, -0.5, -0.5};  // of the node and its ends in d_e - (d_a + d_b)/2
  for (std::size_t e = 0; e < ends.size(); ++e) {
    if (ends[e][0] < 0) continue;
    const int nodes[3] = {static_cast<int>(e), ends[e][0], ends[e][1]};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        double* to = matrix.block(graph_->find(nodes[i], nodes[j]));
        for (int k = 0; k < n; ++k) to[k] += share[i] * share[j] * weights[e * n + k];
      }
  }
}

#define FSI_INSTANTIATE(Element) template class MotionOfVertices<Element>;
FSI_FOR_EACH_QUADRATIC_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
