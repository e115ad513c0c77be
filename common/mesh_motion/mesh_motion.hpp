#pragma once

#include <vector>

#include "algebra/block_matrix.hpp"
#include "fem/contributions.hpp"
#include "fem/element_packs.hpp"

namespace fsi {

/// Harmonic mesh motion: (grad d_m, grad v) = 0 with d_m given on the boundary; paper, section 2.5.
struct HarmonicMeshMotion {
  template <class T>
  Integrand<T> integrand(const Mat3<T>& grad_d) const {
    Integrand<T> f;
    const T zero(0.0);
    f.source = {{zero, zero, zero}};
    f.flux = grad_d;
    f.scalar_source = zero;
    f.scalar_flux = {{zero, zero, zero}};
    return f;
  }
};

/// The operator of the mesh motion: components do not couple, each node pair holds one number per component. Constant,
/// so assembled once, unless a case wants to see what that saves.
template <class Element>
using MeshMotionMatrix = BlockMatrix<1, Element::components>;

/// Assembles the operator, without boundary conditions.
template <class Element>
void assemble_mesh_motion(const ElementPacks<Element>& packs, MeshMotionMatrix<Element>& matrix) {
  constexpr int n = Element::components;
  matrix.set_zero();
  for_each_thread(packs, serial_jacobian_elements, [&](int, const auto& mine) {
    const HarmonicMeshMotion form;
    const NodalVector<Element> zero{};
    ElementRows<Element, Dual<n>> rows;
    for (const auto& pack : mine)
      for (int b = 0; b < Element::nodes; ++b) {
        integrate(
            rows, pack.geometry,
            [&](const auto& g) { return seed_gradient<Element, n, 0>(gradient_of(zero, g), g, b); },
            [&](const auto& grad_d, const auto&, int) { return form.integrand(grad_d); });
        for (int a = 0; a < Element::nodes; ++a)
          for (int lane = 0; lane < pack_width; ++lane) {
            const int position = pack.position[a * Element::nodes + b][lane];
            if (position < 0) continue;
            for (int k = 0; k < n; ++k) matrix.block(position)[k] += rows.at[a][k].slope[k].lanes[lane];
          }
      }
  });
}

/// r = A d, `components` entries per node.
template <class Element>
void multiply_mesh_motion(const MeshMotionMatrix<Element>& matrix, const std::vector<double>& d,
                          std::vector<double>& r) {
  constexpr int n = Element::components;
  const auto& graph = *matrix.graph;
#pragma omp parallel for schedule(static) if (graph.blocks() > 200000)
  for (int row = 0; row < graph.rows(); ++row) {
    double sum[n] = {};
    for (int at = graph.offsets[row]; at < graph.offsets[row + 1]; ++at)
      for (int k = 0; k < n; ++k)
        sum[k] += matrix.block(at)[k] * d[static_cast<std::size_t>(graph.columns[at]) * n + k];
    for (int k = 0; k < n; ++k) r[static_cast<std::size_t>(row) * n + k] = sum[k];
  }
}

}  // namespace fsi
