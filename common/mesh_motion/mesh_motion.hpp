#pragma once

#include <vector>

#include "algebra/block_matrix.hpp"
#include "fem/element_packs.hpp"
#include "fem/nodal_layout.hpp"

namespace fsi {

/// The operator of the mesh motion: components do not couple, each node pair holds one number per component. Constant,
/// so assembled once, unless a case wants to see what that saves.
template <class Element>
using MeshMotionMatrix = BlockMatrix<1, Element::components>;

/// Assembles the operator of the harmonic mesh motion, without boundary conditions.
template <class Element>
void assemble_mesh_motion(const ElementPacks<Element>& packs, MeshMotionMatrix<Element>& matrix);

/// r = A d, both in the vector layout.
template <class Element>
void multiply_mesh_motion(const MeshMotionMatrix<Element>& matrix, const std::vector<double>& d,
                          std::vector<double>& r) {
  constexpr int n = Element::components;
  const auto& graph = *matrix.graph;
#pragma omp parallel for schedule(static) if (graph.blocks() > 200000)
  for (int row = 0; row < graph.rows(); ++row) {
    double sum[n] = {};
    for (int at = graph.offsets[row]; at < graph.offsets[row + 1]; ++at)
      for (int k = 0; k < n; ++k) sum[k] += matrix.block(at)[k] * d[VectorLayout<n>::vector(graph.columns[at], k)];
    for (int k = 0; k < n; ++k) r[VectorLayout<n>::vector(row, k)] = sum[k];
  }
}

}  // namespace fsi
