#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <vector>

#include "algebra/block_matrix.hpp"
#include "fem/nodal_layout.hpp"

namespace fsi {

template <int n>
using Direction = std::array<double, n>;  ///< along the components of vectors

/// Axes of a node: component k of a vector in the node's frame is its scalar product with axes[k]. Orthonormal.
template <int n>
using NodalAxes = std::array<Direction<n>, n>;

/// Nodes whose vectors are counted along axes of their own in systems of equations, because a condition holds for a
/// component that is along no axis of space (docs/theory.md, section 2.4). Fields and residuals are kept along the axes
/// of space; at these few nodes they are turned into the frames and back where a system of equations begins.
template <int n>
class NodalFrames {
 public:
  bool empty() const { return nodes_.empty(); }
  const std::vector<int>& nodes() const { return nodes_; }
  /// Null where components are along the axes of space.
  const NodalAxes<n>* at(int node) const {
    return static_cast<std::size_t>(node) < place_.size() && place_[node] >= 0 ? &axes_[place_[node]] : nullptr;
  }
  /// Gives a node its axes; once per node.
  void turn(int node, const NodalAxes<n>& axes) {
    assert(at(node) == nullptr);
    if (static_cast<std::size_t>(node) >= place_.size()) place_.resize(static_cast<std::size_t>(node) + 1, -1);
    place_[node] = static_cast<int>(nodes_.size());
    nodes_.push_back(node);
    axes_.push_back(axes);
  }

  /// From components along the axes of space to those in the frames.
  template <class Layout>
  void to_frames(std::vector<double>& field) const {
    for (std::size_t i = 0; i < nodes_.size(); ++i) to_frame(axes_[i], field.data() + Layout::vector(nodes_[i]));
  }
  /// From components in the frames to those along the axes of space.
  template <class Layout>
  void to_space(std::vector<double>& field) const {
    for (std::size_t i = 0; i < nodes_.size(); ++i) to_space(axes_[i], field.data() + Layout::vector(nodes_[i]));
  }

  static void to_frame(const NodalAxes<n>& axes, double* x) {
    Direction<n> turned{};
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) turned[i] += axes[i][k] * x[k];
    std::copy_n(turned.begin(), n, x);
  }
  static void to_space(const NodalAxes<n>& axes, double* x) {
    Direction<n> turned{};
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) turned[k] += axes[i][k] * x[i];
    std::copy_n(turned.begin(), n, x);
  }

  /// Turns the first n rows and columns of a matrix's blocks, those of vectors, between nodes of this part.
  template <int Rows, int Columns>
  void turn_blocks(BlockMatrix<Rows, Columns>& matrix) const {
    static_assert(Rows >= n && Columns >= n);
    if (empty()) return;
    const auto& graph = *matrix.graph;
#pragma omp parallel for schedule(static) if (graph.blocks() > 40000)
    for (int a = 0; a < graph.rows(); ++a) {
      const NodalAxes<n>* of_row = at(a);
      for (int position = graph.offsets[a]; position < graph.offsets[a + 1]; ++position) {
        const NodalAxes<n>* of_column = at(graph.columns[position]);
        if (!of_row && !of_column) continue;
        double* block = matrix.block(position);
        if (of_column)
          for (int row = 0; row < Rows; ++row) to_frame(*of_column, block + row * Columns);
        for (int column = 0; column < Columns && of_row; ++column) {
          Direction<n> x;
          for (int row = 0; row < n; ++row) x[row] = block[row * Columns + column];
          to_frame(*of_row, x.data());
          for (int row = 0; row < n; ++row) block[row * Columns + column] = x[row];
        }
      }
    }
  }

  /// A matrix that does not couple components of space does so in the frames: component i at node a with j at node b by
  /// the sum over k of share(k, a, b, i, j) times its number for component k of space.
  double share(int k, int a, int b, int i, int j) const {
    const NodalAxes<n>*of_row = at(a), *of_column = at(b);
    return (of_row ? (*of_row)[i][k] : i == k ? 1.0 : 0.0) * (of_column ? (*of_column)[j][k] : j == k ? 1.0 : 0.0);
  }

 private:
  std::vector<int> nodes_;
  std::vector<NodalAxes<n>> axes_;  ///< in the order of the nodes
  std::vector<int> place_;          ///< per node, among those; -1: none. Up to the last node that has a frame
};

/// Entries of a vector field that vanish, in the vector layout, components at some nodes being those of their frames.
template <int n>
struct VanishingComponents {
  std::vector<std::size_t> entries;
  NodalFrames<n> frames;

  /// Takes these components out of a field along the axes of space.
  void clear(std::vector<double>& field) const {
    frames.template to_frames<VectorLayout<n>>(field);
    for (const std::size_t entry : entries) field[entry] = 0;
    frames.template to_space<VectorLayout<n>>(field);
  }
};

}  // namespace fsi
