#pragma once

#include <algorithm>
#include <vector>

#include "fem/nodal_layout.hpp"
#include "linear/velocity_pressure/velocity_pressure_layout.hpp"

namespace fsi {

/// Shape derivatives that need no harmonic extension: those of the interface's own momentum equations by the
/// displacement of the interface's nodes, d_m = (mesh factor / velocity factor) v there. They are by far the largest.
/// What is left of them acts through d_m inside the fluid and is small: with a pressure that does not vary and test
/// functions on the interface,
///   int p J F^-T : grad v dX = int over the current interface of p n . v,
/// whose derivative knows displacements of the interface only. This is the stiffness by which a pressure follows the
/// surface; it has the order of p / h, that of the wall mu / h.
/// \tparam n  components of a velocity
template <int n>
class InterfaceShapeDerivatives {
 public:
  InterfaceShapeDerivatives(const JacobianBlocks<n>& blocks, const VelocityPressureLayout<n>& layout)
      : blocks_(blocks), layout_(layout) {
    if (!blocks.shape_derivatives || blocks.numbering.mesh.empty()) return;
    const auto& graph = *blocks.shape_derivatives->graph;
    std::vector<char> moves_with_it(graph.rows(), 0);
    for (int a = 0; a < graph.rows(); ++a)
      for (int k = 0; k < n; ++k) moves_with_it[a] = moves_with_it[a] || follows(a, k);
    for (int row = 0; row < graph.rows(); ++row)
      for (int at = graph.offsets[row]; moves_with_it[row] && at < graph.offsets[row + 1]; ++at) {
        if (!blocks.fluid_nodes->owns(row)) break;
        const int column = graph.columns[at];
        if (!moves_with_it[column]) continue;
        couplings_.push_back({layout.velocity_of_fluid[row], layout.velocity_of_fluid[column], row, column, at});
      }
    std::stable_sort(couplings_.begin(), couplings_.end(), by_velocity);
  }

  /// Calls add(column, row in its block, column in it, value to add) for the present values of a velocity node's row.
  template <class Add>
  void for_row(int v, Add add) const {
    const auto row = std::equal_range(couplings_.begin(), couplings_.end(), Coupling{v, 0, 0, 0, 0}, by_velocity);
    for (auto c = row.first; c != row.second; ++c)
      for_numbers(*c, [&](int i, int k, double value, double factor) { add(c->u, i, k, factor * value); });
  }
  /// rows += their product with a displacement of the mesh.
  /// \param mesh  n numbers a fluid node \param rows  n numbers a velocity node
  void add_product(const std::vector<double>& mesh, std::vector<double>& rows) const {
    for (const Coupling& c : couplings_)
      for_numbers(c, [&](int i, int k, double value, double /*factor*/) {
        rows[VectorLayout<n>::vector(c.v, i)] += value * mesh[VectorLayout<n>::vector(c.column, k)];
      });
  }

 private:
  /// A fluid node of the interface, its neighbour there, and the block that couples them.
  struct Coupling {
    int v, u;  ///< their velocity nodes
    int row, column, shape;
  };
  static bool by_velocity(const Coupling& a, const Coupling& b) { return a.v < b.v; }

  /// Calls visit(row in the block, column in it, value by displacements, factor that makes it one by velocities).
  template <class Visit>
  void for_numbers(const Coupling& c, Visit visit) const {
    const double* block = blocks_.shape_derivatives->block(c.shape);
    for (int k = 0; k < n; ++k) {
      if (!follows(c.column, k)) continue;
      const double factor = blocks_.numbering.mesh[VectorLayout<n>::vector(c.column, k)].factor /
                            blocks_.numbering.fluid[MixedLayout<n>::vector(c.column, k)].factor;
      for (int i = 0; i < n; ++i)
        if (layout_.is_free(false, c.row, i)) visit(i, k, block[VectorLayout<n>::vector(i, k)], factor);
    }
  }

  /// The node's displacement has the unknown of its velocity.
  bool follows(int node, int k) const {
    const auto displacement = blocks_.numbering.mesh[VectorLayout<n>::vector(node, k)].index;
    return displacement >= 0 && displacement == blocks_.numbering.fluid[MixedLayout<n>::vector(node, k)].index;
  }

  JacobianBlocks<n> blocks_;
  const VelocityPressureLayout<n>& layout_;
  std::vector<Coupling> couplings_;  ///< by velocity node
};

}  // namespace fsi
