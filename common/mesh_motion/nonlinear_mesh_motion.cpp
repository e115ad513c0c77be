#include "mesh_motion/nonlinear_mesh_motion.hpp"

#include "fem/contributions.hpp"
#include "fem/elements.hpp"
#include "mesh_motion/stiffening.hpp"

namespace fsi {

namespace {

/// Rows and, by seeding one node after the other, derivatives.
template <class Element, bool Derivatives>
AssemblyResult assemble_packs(const PseudoSolid& form,
                              const std::vector<typename ElementPacks<Element>::ElementPack>& packs,
                              const std::vector<double>& stiffness, const std::vector<double>& mesh, double* residual,
                              double* blocks) {
  constexpr int n = Element::components, seeds = Derivatives ? n : 0;
  AssemblyResult result;
  NodalVector<Element> d{};
  ElementRows<Element, Seeded<seeds>> rows;
  for (const auto& pack : packs) {
    gather<VectorLayout<n>>(d, pack, mesh.data());
    const Pack k = stiffness_of(stiffness, pack.cell);
    for (int b = 0; b < (Derivatives ? Element::nodes : 1); ++b) {
      integrate(
          rows, pack.geometry,
          [&](const auto& g) {
            const auto s = form.stress(seed_gradient<Element, seeds, 0>(gradient_of(d, g), g, b), k);
            if (b == 0) result.include(value_of(s.volume_ratio), pack.cell.data());
            return s;
          },
          [&](const auto& s, const auto&, int) { return form.integrand(s); });
      for (int a = 0; a < Element::nodes; ++a)
        for (int lane = 0; lane < pack_width; ++lane) {
          if (b == 0 && pack.position[a * Element::nodes + a][lane] >= 0)
            for (int i = 0; i < n; ++i)
              residual[VectorLayout<n>::vector(pack.node[a][lane], i)] += value_of(rows.at[a][i])[lane];
          if constexpr (Derivatives) {
            const int position = pack.position[a * Element::nodes + b][lane];
            if (position < 0) continue;
            double* block = blocks + static_cast<std::size_t>(position) * (n * n);
            for (int i = 0; i < n; ++i)
              for (int j = 0; j < n; ++j) block[i * n + j] += rows.at[a][i].slope[j].lanes[lane];
          }
        }
    }
  }
  return result;
}

}  // namespace

template <class Element>
AssemblyResult ElasticMeshMotion<Element>::assemble(const std::vector<double>& mesh, std::vector<double>& residual,
                                                    MeshMotionTangent<n>* tangent) const {
  residual.assign(mesh.size(), 0.0);
  if (tangent) tangent->set_zero();
  std::vector<AssemblyResult> results(packs_.thread_count());
  for_each_thread(packs_, tangent ? serial_jacobian_elements : serial_residual_elements, [&](int t, const auto& mine) {
    results[t] =
        tangent ? assemble_packs<Element, true>(form_, mine, stiffness_, mesh, residual.data(), tangent->values.data())
                : assemble_packs<Element, false>(form_, mine, stiffness_, mesh, residual.data(), nullptr);
  });
  return reduced(results);
}

#define FSI_INSTANTIATE(Element) template class ElasticMeshMotion<Element>;
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
