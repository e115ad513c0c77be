#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fem/nodal_layout.hpp"
#include "linear/velocity_pressure/velocity_pressure_layout.hpp"

namespace fsi {

/// The assembled blocks of both media as rows and columns of one velocity and the pressures, as every matrix of that
/// system is filled from them.
template <int n>
class VelocityPressureBlocks {
 public:
  /// \param layout  of these blocks; must outlive this
  VelocityPressureBlocks(const JacobianBlocks<n>& blocks, const VelocityPressureLayout<n>& layout)
      : blocks_(blocks), layout_(layout) {}

  const VelocityPressureLayout<n>& layout() const { return layout_; }
  /// Places at rest of the wall's nodes, mm; there must be a wall.
  const std::vector<std::array<double, 3>>& wall_points() const { return blocks_.wall_nodes->nodes; }

  /// Calls visit(block, velocity or -1, pressure or -1, factor of the velocity) for the assembled blocks of the rows of
  /// a velocity's nodes, the fluid's first; `factor` turns derivatives by displacement into those by velocity. Rows and
  /// columns of components that are no unknowns are zero in `block`, but for a number on the diagonal of a component
  /// that is none in either medium.
  template <class Visit>
  void for_blocks_of(int velocity, Visit visit) const {
    layout_.for_nodes_of(velocity, [&](const auto& of) { for_blocks_of_node(of.wall, of.node, visit); });
  }
  /// The same for the rows of one node. \param wall  the node is the wall's, else the fluid's
  template <class Visit>
  void for_blocks_of_node(bool wall, int node, Visit visit) const {
    const auto& matrix = wall ? *blocks_.wall : *blocks_.fluid;
    const auto& velocity_of = wall ? layout_.velocity_of_wall : layout_.velocity_of_fluid;
    const auto& pressure_of = wall ? layout_.pressure_of_wall : layout_.pressure_of_fluid;
    const double factor = wall ? layout_.wall_factor : 1;
    const auto& graph = *matrix.graph;
    const bool partly_fixed = layout_.partly_fixed();
    double constrained[MixedLayout<n>::entries * MixedLayout<n>::entries];
    for (int at = graph.offsets[node]; at < graph.offsets[node + 1]; ++at) {
      const int b = graph.columns[at];
      const double* block = matrix.block(at);
      if (partly_fixed) {
        constrain(wall, node, b, block, constrained);
        block = constrained;
      }
      visit(block, velocity_of[b], pressure_of[b], factor);
    }
  }

 private:
  /// `to` = the block that couples two nodes of a part, without the components that are no unknowns. A component that
  /// is none in any medium gets a diagonal as large as the others', once.
  void constrain(bool wall, int row, int column, const double* block, double* to) const {
    std::copy(block, block + MixedLayout<n>::entries * MixedLayout<n>::entries, to);
    for (int k = 0; k < n; ++k) {
      if (!layout_.is_free(wall, row, k))
        std::fill_n(to + MixedLayout<n>::in_block(k, 0), MixedLayout<n>::entries, 0.0);
      if (!layout_.is_free(wall, column, k))
        for (int i = 0; i <= n; ++i) to[MixedLayout<n>::in_block(i, k)] = 0;
    }
    if (row != column) return;
    const int v = (wall ? layout_.velocity_of_wall : layout_.velocity_of_fluid)[row];
    if (v < 0 || !layout_.is_first(wall, row, v)) return;
    double largest = 0;
    for (int k = 0; k < n; ++k) largest = std::max(largest, std::abs(block[MixedLayout<n>::in_block(k, k)]));
    for (int k = 0; k < n; ++k)
      if (!layout_.is_free(v, k)) to[MixedLayout<n>::in_block(k, k)] = largest > 0 ? largest : 1;
  }

  JacobianBlocks<n> blocks_;
  const VelocityPressureLayout<n>& layout_;
};

}  // namespace fsi
