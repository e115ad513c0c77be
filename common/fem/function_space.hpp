#pragma once

#include <memory>
#include <numeric>
#include <vector>

#include "algebra/node_graph.hpp"
#include "fem/nodal_layout.hpp"
#include "math/tensor.hpp"
#include "mesh/submesh.hpp"

namespace fsi {

/// The fields of one medium on its part of the mesh: vectors at all nodes, scalars at the first
/// Element::scalar_nodes of each cell. It owns which nodes carry what, how many numbers arrays have, which nodes
/// couple, and how large the node of a norm is. Where the numbers stand is said by VectorLayout and MixedLayout.
template <class Element>
class FunctionSpace {
 public:
  static constexpr int n = Element::components;
  using Vector = VectorLayout<n>;
  using Mixed = MixedLayout<n>;

  /// \param part  read here only, but for the number of its cells
  explicit FunctionSpace(const Submesh<Element::dim, Element::order>& part)
      : nodes_(part.node_count()), cells_(part.cells.size()) {
    carries_scalar_.assign(part.nodes.size(), 0);
    std::vector<int> cell_nodes;
    cell_nodes.reserve(part.cells.size() * Element::nodes);
    for (const auto& cell : part.cells) {
      cell_nodes.insert(cell_nodes.end(), cell.begin(), cell.end());
      for (int a = 0; a < Element::scalar_nodes; ++a) carries_scalar_[cell[a]] = 1;
    }
    graph_ = std::make_shared<NodeGraph>(graph_of_cells(nodes_, cell_nodes, Element::nodes));
  }

  int node_count() const { return nodes_; }
  bool carries_scalar(int node) const { return carries_scalar_[node] != 0; }
  std::size_t vector_size() const { return Vector::size(nodes_); }
  std::size_t mixed_size() const { return Mixed::size(nodes_); }
  /// Nodes that share a cell.
  const std::shared_ptr<const NodeGraph>& graph() const { return graph_; }

  std::vector<int> all_cells() const {
    std::vector<int> all(cells_);
    std::iota(all.begin(), all.end(), 0);
    return all;
  }

 private:
  int nodes_;
  std::size_t cells_;
  std::vector<char> carries_scalar_;
  std::shared_ptr<const NodeGraph> graph_;
};

/// The volume that belongs to each node, mm^3: positive, and adding up to the part's; weights of lumped L2 norms. The
/// integral of N_a for linear shape functions; else each cell's volume is shared out in the ratio of the integrals of
/// N_a^2 [Hinton1976], since those of quadratic shape functions are not positive at vertices.
template <class Element>
std::vector<double> nodal_volumes(const Submesh<Element::dim, Element::order>& part) {
  std::vector<double> volumes(part.nodes.size(), 0.0);
  for (const auto& cell : part.cells) {
    Vec3<Pack> x[Element::nodes];
    for (int a = 0; a < Element::nodes; ++a)
      for (int i = 0; i < 3; ++i) x[a][i] = Pack(part.nodes[cell[a]][i]);
    const auto geometry = Element::geometry(x);
    double total = 0, squares = 0, square[Element::nodes] = {};
    for (int q = 0; q < Element::points; ++q) {
      const auto g = Element::at(geometry, q);
      for (int a = 0; a < Element::nodes; ++a) {
        const double value = g.vectors().value[a];
        if constexpr (Element::order == 1) {
          volumes[cell[a]] += g.weight[0] * value;
        } else {
          square[a] += g.weight[0] * value * value;
          squares += g.weight[0] * value * value;
        }
      }
      total += g.weight[0];
    }
    if constexpr (Element::order > 1)
      for (int a = 0; a < Element::nodes; ++a) volumes[cell[a]] += total * square[a] / squares;
  }
  return volumes;
}

}  // namespace fsi
