#include "mesh_motion/mesh_motion.hpp"

#include "fem/elements.hpp"
#include "math/kinematics.hpp"
#include "mesh_motion/harmonic.hpp"
#include "mesh_motion/stiffening.hpp"

namespace fsi {

template <class Element>
void assemble_mesh_motion(const ElementPacks<Element>& packs, MeshMotionMatrix<Element::components>& matrix,
                          const std::vector<double>& stiffness, std::vector<double>* diagonals) {
  constexpr int n = Element::components;
  matrix.set_zero();
  for_each_thread(packs, serial_jacobian_elements, [&](int, const auto& mine) {
    const HarmonicMeshMotion form;
    const NodalVector<Element> zero{};
    ElementRows<Element, Dual<n>> rows;
    for (const auto& pack : mine) {
      const Pack k_of_cells = stiffness_of(stiffness, pack.cell);
      Pack diagonal[n];
      for (Pack& sum : diagonal) sum = Pack(0.0);
      for (int b = 0; b < Element::nodes; ++b) {
        integrate(
            rows, pack.geometry,
            [&](const auto& g) { return seed_gradient<Element, n, 0>(gradient_of(zero, g), g, b); },
            [&](const auto& grad_d, const auto&, int) { return form.integrand(grad_d, k_of_cells); });
        for (int a = 0; a < Element::nodes; ++a)
          for (int lane = 0; lane < pack_width; ++lane) {
            const int position = pack.position[a * Element::nodes + b][lane];
            if (position < 0) continue;
            for (int k = 0; k < n; ++k) matrix.block(position)[k] += rows.at[a][k].slope[k].lanes[lane];
          }
        for (int k = 0; k < n; ++k) diagonal[k] += rows.at[b][k].slope[k];
      }
      if (!diagonals || !pack.counted_here()) continue;
      for (int lane = 0; lane < pack.filled; ++lane)
        for (int k = 0; k < n; ++k)
          (*diagonals)[static_cast<std::size_t>(pack.cell[lane]) * n + k] = diagonal[k][lane] / Element::nodes;
    }
  });
}

template <class Element>
AssemblyResult smallest_volume_ratio(const ElementPacks<Element>& packs, const std::vector<double>& mesh) {
  std::vector<AssemblyResult> results(packs.thread_count());
  for_each_thread(packs, serial_residual_elements, [&](int t, const auto& mine) {
    NodalVector<Element> d{};
    for (const auto& pack : mine) {
      gather<VectorLayout<Element::components>>(d, pack, mesh.data());
      for (int q = 0; q < Element::points; ++q)
        results[t].include(volume_change(gradient_of(d, Element::at(pack.geometry, q))) + 1.0, pack.cell.data());
    }
  });
  return reduced(results);
}

#define FSI_INSTANTIATE(Element) \
  template AssemblyResult smallest_volume_ratio(const ElementPacks<Element>&, const std::vector<double>&);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

#define FSI_INSTANTIATE(Element)                                                                           \
  template void assemble_mesh_motion(const ElementPacks<Element>&, MeshMotionMatrix<Element::components>&, \
                                     const std::vector<double>&, std::vector<double>*);
FSI_FOR_EACH_LINEAR_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
