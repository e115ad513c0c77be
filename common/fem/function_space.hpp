#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "algebra/node_graph.hpp"
#include "fem/nodal_layout.hpp"
#include "math/tensor.hpp"
#include "mesh/submesh.hpp"

namespace fsi {

/// The fields of one medium on its part of the mesh, vectors with n components: which nodes carry what, the sizes of
/// arrays, which nodes couple, and the volume of each node, which weighs norms. VectorLayout and MixedLayout say where
/// the numbers stand.
template <int n>
class FunctionSpace {
 public:
  using Vector = VectorLayout<n>;
  using Mixed = MixedLayout<n>;

  /// \param carries_scalar  per node
  /// \param graph           nodes that share a cell
  /// \param volumes         nodal_volumes(), mm^3
  FunctionSpace(std::vector<char> carries_scalar, std::shared_ptr<const NodeGraph> graph, std::vector<double> volumes)
      : carries_scalar_(std::move(carries_scalar)), graph_(std::move(graph)), volumes_(std::move(volumes)) {}

  int node_count() const { return static_cast<int>(carries_scalar_.size()); }
  bool carries_scalar(int node) const { return carries_scalar_[node] != 0; }
  std::size_t vector_size() const { return Vector::size(node_count()); }
  std::size_t mixed_size() const { return Mixed::size(node_count()); }
  /// Nodes that share a cell.
  const std::shared_ptr<const NodeGraph>& graph() const { return graph_; }
  /// The volume that belongs to each node, mm^3 (nodal_volumes); ghosts have their owners' values.
  const std::vector<double>& volumes() const { return volumes_; }

 private:
  std::vector<char> carries_scalar_;
  std::shared_ptr<const NodeGraph> graph_;
  std::vector<double> volumes_;
};

/// The volume that belongs to each node, mm^3: positive, and adding up to the part's; weights of lumped L2 norms. The
/// integral of N_a for linear shape functions; else each cell's volume is distributed in the ratio of the integrals of
/// N_a^2 [Hinton1976], since integrals of quadratic shape functions are not positive at vertices.
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

/// The space of an element on a part: vectors at all nodes, scalars at the first Element::scalar_nodes of each cell.
/// Collective over the processes that share the part.
template <class Element>
FunctionSpace<Element::components> function_space(const Submesh<Element::dim, Element::order>& part) {
  std::vector<char> carries_scalar(part.nodes.size(), 0);
  std::vector<int> cell_nodes;
  cell_nodes.reserve(part.cells.size() * Element::nodes);
  for (const auto& cell : part.cells) {
    cell_nodes.insert(cell_nodes.end(), cell.begin(), cell.end());
    for (int a = 0; a < Element::scalar_nodes; ++a) carries_scalar[cell[a]] = 1;
  }
  auto graph = std::make_shared<NodeGraph>(graph_of_cells(part.node_count(), cell_nodes, Element::nodes));
  std::vector<double> volumes = nodal_volumes<Element>(part);
  if (part.share) {  // not all cells around ghosts are here
    part.share->exchange.update(volumes);
    std::vector<double> carries(carries_scalar.begin(), carries_scalar.end());
    part.share->exchange.update(carries);
    std::transform(carries.begin(), carries.end(), carries_scalar.begin(), [](double c) { return c != 0 ? 1 : 0; });
  }
  return {std::move(carries_scalar), std::move(graph), std::move(volumes)};
}

}  // namespace fsi
