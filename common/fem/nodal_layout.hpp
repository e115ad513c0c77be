#pragma once

#include <cstddef>

namespace fsi {

/// Where nodal values stand in arrays, for vector fields of `Components` components. Nodal arrays of all fields, the
/// rows of residuals and of block matrices keep to this: nothing else multiplies node numbers.

/// A vector field alone: displacement of the fluid's mesh, accelerations.
template <int Components>
struct VectorLayout {
  static constexpr int entries = Components;  ///< per node
  static constexpr std::size_t size(int nodes) { return static_cast<std::size_t>(nodes) * entries; }
  static constexpr std::size_t vector(int node, int component = 0) {
    return static_cast<std::size_t>(node) * entries + static_cast<std::size_t>(component);
  }
};

/// A vector and a scalar field: (u, p) of the fluid, (d, p) of the wall. The scalar has a place at every node, also at
/// those that carry none (FunctionSpace::carries_scalar): there it belongs to no unknown.
template <int Components>
struct MixedLayout {
  static constexpr int entries = Components + 1;  ///< per node
  static constexpr std::size_t size(int nodes) { return static_cast<std::size_t>(nodes) * entries; }
  static constexpr std::size_t vector(int node, int component = 0) {
    return static_cast<std::size_t>(node) * entries + static_cast<std::size_t>(component);
  }
  static constexpr std::size_t scalar(int node) { return vector(node, Components); }
  /// Of a row and a column in a square block that couples two nodes; the scalar's are the last.
  static constexpr int in_block(int row, int column) { return row * entries + column; }
};

}  // namespace fsi
