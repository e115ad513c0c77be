#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "monolithic/block/coupled_matrix.hpp"
#include "system/linear_solver.hpp"

namespace fsi {

/// What is prescribed at the nodes of the coupled system, per node one flag for all components of its vector.
struct CoupledConstraints {
  std::vector<char> mesh_fixed;      ///< d_m = 0, or equal to d_s
  std::vector<char> velocity_fixed;  ///< u = 0
  std::vector<char> wall_fixed;      ///< d_s = 0, or tied to u
};

/// A pair of nodes that the interface conditions tie, d_m = d_s and u = d(d_s)/dt.
struct InterfacePair {
  int fluid, wall;
};

/// The paper's K x = b made from the Jacobian of a scene, which numbers one unknown on the interface: matrix, and the
/// ways of right-hand sides and solutions to and fro. Fluid and wall must both be there.
template <class Element>
class CoupledSystem {
 public:
  static constexpr int n = Element::components;

  explicit CoupledSystem(const JacobianBlocks<Element>& blocks) : blocks_(blocks) {
    const auto& scene = blocks.scene;
    mesh_ = BlockMatrix<1, n>(blocks.mesh->graph);
    flow_ = BlockMatrix<n + 1, n + 1>(blocks.flow->graph);
    flow_mesh_ = BlockMatrix<n + 1, n>(blocks.shape_derivatives->graph);
    wall_ = BlockMatrix<n + 1, n + 1>(blocks.wall->graph);
    k_ = {&mesh_, &mesh_wall_, &flow_mesh_, &flow_, &flow_wall_, &wall_flow_, &wall_};
    constraints_.mesh_fixed = fixed_nodes(scene.mesh_conditions);
    constraints_.velocity_fixed = fixed_nodes(scene.velocity_conditions);
    constraints_.wall_fixed = fixed_nodes(scene.wall_conditions);
    clamped_ = constraints_.wall_fixed;
    std::vector<int> wall_of(static_cast<std::size_t>(k_.fluid_nodes()), -1),
        fluid_of(static_cast<std::size_t>(k_.wall_nodes()), -1);
    for (const auto& node : scene.interface) {
      constraints_.mesh_fixed[node.fluid] = constraints_.wall_fixed[node.wall] = 1;
      if (node.clamped || clamped_[node.wall]) {
        constraints_.velocity_fixed[node.fluid] = 1;
      } else {
        interface_.push_back({node.fluid, node.wall});
        wall_of[node.fluid] = node.wall;
        fluid_of[node.wall] = node.fluid;
      }
    }
    mesh_zero_ = constraints_.mesh_fixed;  // columns of interface nodes stay, they are unknowns
    for (const auto& pair : interface_) mesh_zero_[pair.fluid] = 0;
    mesh_wall_ = tie(wall_of);
    wall_flow_ = tie(fluid_of);

    // Afs: the wall's momentum rows of the interface nodes.
    auto graph = std::make_shared<NodeGraph>();
    graph->offsets.assign(1, 0);
    for (int wall_node : wall_of) {
      if (wall_node >= 0) {
        const auto& wall = *blocks.wall->graph;
        for (int at = wall.offsets[wall_node]; at < wall.offsets[wall_node + 1]; ++at) {
          graph->columns.push_back(wall.columns[at]);
          traction_.push_back(at);
        }
      }
      graph->offsets.push_back(static_cast<int>(graph->columns.size()));
    }
    flow_wall_ = BlockMatrix<n, n + 1>(std::move(graph));
  }

  CoupledSystem(const CoupledSystem&) = delete;  // the matrix refers to its blocks
  CoupledSystem& operator=(const CoupledSystem&) = delete;

  const CoupledMatrix<n>& matrix() const { return k_; }
  const CoupledConstraints& constraints() const { return constraints_; }
  /// The interface nodes that can move.
  const std::vector<InterfacePair>& interface() const { return interface_; }

  /// Takes over the values that the block matrices hold now.
  void update() {
    const double rate = blocks_.numbering.interface.rate();
    update_mesh_motion();
    copy(*blocks_.flow, flow_);
    impose(flow_, constraints_.velocity_fixed, constraints_.velocity_fixed, [](int) { return 1.0; });
    copy(*blocks_.shape_derivatives, flow_mesh_);
    impose(flow_mesh_, constraints_.velocity_fixed, mesh_zero_, [](int) { return 0.0; });
    const auto tractions = static_cast<std::ptrdiff_t>(traction_.size());
#pragma omp parallel for schedule(static) if (tractions > 20000)
    for (std::ptrdiff_t i = 0; i < tractions; ++i) {
      const double* from = blocks_.wall->block(traction_[i]);
      std::copy(from, from + n * (n + 1), flow_wall_.block(static_cast<int>(i)));
    }
    impose(flow_wall_, {}, clamped_, [](int) { return 0.0; });
    copy(*blocks_.wall, wall_);
    impose(wall_, constraints_.wall_fixed, clamped_, [&](int node) { return clamped_[node] ? 1.0 : rate; });
  }

  /// Takes over the mesh motion's operator alone.
  void update_mesh_motion() {
    copy(*blocks_.mesh, mesh_);
    impose_diagonal();
  }

  /// b of K from b of the numbering: mesh, flow and wall equations to their rows; identity rows are zero.
  void expand(const std::vector<double>& condensed, CoupledVector& b) const {
    const auto& numbering = blocks_.numbering;
    const auto take = [&](const UnknownMap& rows, std::vector<double>& part) {
      part.resize(rows.size());
      for (std::size_t i = 0; i < rows.size(); ++i) part[i] = rows[i].index >= 0 ? condensed[rows[i].index] : 0.0;
    };
    take(numbering.mesh_rows, b.mesh);
    take(numbering.flow_rows, b.flow);
    take(numbering.wall_rows, b.wall);
    for (const auto& pair : interface_)  // their equation is the flow's
      for (int k = 0; k < n; ++k) b.wall[static_cast<std::size_t>(pair.wall) * (n + 1) + k] = 0;
  }

  /// x of the numbering from x of K: on the interface the wall's displacement.
  void compress(const CoupledVector& x, std::vector<double>& condensed) const {
    const auto& numbering = blocks_.numbering;
    condensed.assign(static_cast<std::size_t>(numbering.size), 0.0);
    const auto give = [&](const UnknownMap& unknowns, const std::vector<double>& part) {
      for (std::size_t i = 0; i < unknowns.size(); ++i)
        if (unknowns[i].index >= 0) condensed[unknowns[i].index] = part[i] / unknowns[i].factor;
    };
    give(numbering.mesh, x.mesh);
    give(numbering.flow, x.flow);
    give(numbering.wall, x.wall);  // last: it owns the interface
  }

 private:
  static std::vector<char> fixed_nodes(const DirichletConditions<n>& conditions) {
    std::vector<char> fixed(static_cast<std::size_t>(conditions.node_count()), 0);
    for (int a = 0; a < conditions.node_count(); ++a) fixed[a] = conditions.fixes(a);
    return fixed;
  }

  /// Minus the identity between each node and its partner, if it has one.
  static BlockMatrix<1, 1> tie(const std::vector<int>& partner) {
    auto graph = std::make_shared<NodeGraph>();
    graph->offsets.assign(1, 0);
    for (int other : partner) {
      if (other >= 0) graph->columns.push_back(other);
      graph->offsets.push_back(static_cast<int>(graph->columns.size()));
    }
    BlockMatrix<1, 1> matrix(std::move(graph));
    std::fill(matrix.values.begin(), matrix.values.end(), -1.0);
    return matrix;
  }

  template <class Matrix>
  static void copy(const Matrix& from, Matrix& to) {
    const auto size = static_cast<std::ptrdiff_t>(from.values.size());
#pragma omp parallel for schedule(static) if (size > 100000)
    for (std::ptrdiff_t i = 0; i < size; ++i) to.values[i] = from.values[i];
  }

  /// Vector rows of `fixed_rows` become diagonal, vector columns of `zero_columns` vanish elsewhere; no flags: none.
  template <int Rows, int Columns, class Diagonal>
  static void impose(BlockMatrix<Rows, Columns>& matrix, const std::vector<char>& fixed_rows,
                     const std::vector<char>& zero_columns, Diagonal diagonal) {
    const auto& graph = *matrix.graph;
#pragma omp parallel for schedule(static) if (graph.blocks() > 50000)
    for (int a = 0; a < graph.rows(); ++a) {
      const bool fixed = !fixed_rows.empty() && fixed_rows[a];
      for (int at = graph.offsets[a]; at < graph.offsets[a + 1]; ++at) {
        double* block = matrix.block(at);
        if (zero_columns[graph.columns[at]])
          for (int r = 0; r < Rows; ++r)
            for (int c = 0; c < n; ++c) block[r * Columns + c] = 0;
        if (!fixed) continue;
        const double value = graph.columns[at] == a ? diagonal(a) : 0.0;
        for (int r = 0; r < n; ++r)
          for (int c = 0; c < Columns; ++c) block[r * Columns + c] = r == c ? value : 0.0;
      }
    }
  }

  void impose_diagonal() {
    const auto& graph = *mesh_.graph;
#pragma omp parallel for schedule(static) if (graph.blocks() > 50000)
    for (int a = 0; a < graph.rows(); ++a)
      for (int at = graph.offsets[a]; at < graph.offsets[a + 1]; ++at)
        if (constraints_.mesh_fixed[a] || mesh_zero_[graph.columns[at]])
          for (int k = 0; k < n; ++k) mesh_.block(at)[k] = graph.columns[at] == a ? 1.0 : 0.0;
  }

  JacobianBlocks<Element> blocks_;
  BlockMatrix<1, n> mesh_;
  BlockMatrix<1, 1> mesh_wall_, wall_flow_;
  BlockMatrix<n + 1, n> flow_mesh_;
  BlockMatrix<n, n + 1> flow_wall_;
  BlockMatrix<n + 1, n + 1> flow_, wall_;
  CoupledMatrix<n> k_;
  CoupledConstraints constraints_;
  std::vector<InterfacePair> interface_;
  std::vector<char> clamped_, mesh_zero_;
  std::vector<int> traction_;  ///< position in the wall's matrix of each block of Afs
};

}  // namespace fsi
