#include "wall/viscous_layers.hpp"

#include "fem/element_sums.hpp"
#include "fem/elements.hpp"
#include "fem/interpolation.hpp"
#include "wall/wall_assembly.hpp"

namespace fsi {

namespace {

/// Displacement from the unloaded shape, and what its velocity is a multiple of, in one pack.
template <class Element>
struct ViscousPack {
  NodalVector<Element> d{}, moved{};

  /// \param reference  mixed layout; null: the mesh
  void gather_from(const WallInput& in, const double* reference,
                   const typename ElementPacks<Element>::ElementPack& pack) {
    constexpr int n = Element::components;
    gather<MixedLayout<n>>(d, pack, in.wall);
    NodalVector<Element> from{};
    if (reference) gather<MixedLayout<n>>(from, pack, reference);
    for (int a = 0; a < Element::nodes; ++a)
      for (int k = 0; k < n; ++k) moved.at[a][k] = d.at[a][k] - from.at[a][k];
    if (in.prestress) detail::add_prestress<Element>(d, pack, in.prestress);
  }
};

/// The constants of a thread's packs where they vary, else null.
template <class Element>
using LayerConstants = const std::vector<std::array<PointConstants, Element::points>>*;
template <class Element>
LayerConstants<Element> constants_of(const WallLayer<Element>& layer, int thread) {
  return layer.varies() ? &layer.constants[thread] : nullptr;
}

/// Where the viscosity varies, that of a viscosity of one, which each point multiplies by its own.
template <class Element>
KelvinVoigt form_of(const WallLayer<Element>& layer, const WallInput& in) {
  return {layer.varies() ? 1.0 : layer.viscosity, in.strain_lag};
}

template <class Element, bool Derivatives>
void viscous_packs(const KelvinVoigt& form, const std::vector<typename ElementPacks<Element>::ElementPack>& packs,
                   LayerConstants<Element> constants, const WallInput& in, double* residual, double* blocks) {
  constexpr int n = Element::components;
  constexpr int seeds = Derivatives ? n + 1 : 0;  // displacement, pressure
  using T = Seeded<seeds>;
  const Pack rate(in.velocity_rate);
  ViscousPack<Element> fields;
  ElementRows<Element, T> rows;
  for (std::size_t index = 0; index < packs.size(); ++index) {
    const auto& pack = packs[index];
    fields.gather_from(in, in.velocity_reference, pack);
    for (int b = 0; b < (Derivatives ? Element::nodes : 1); ++b) {
      integrate(
          rows, pack.geometry,
          [&](const auto& g) {
            const Mat3<T> grad_v = rate * seed_gradient<Element, seeds, 0>(gradient_of(fields.moved, g), g, b);
            return form.prepare(seed_gradient<Element, seeds, 0>(gradient_of(fields.d, g), g, b), grad_v);
          },
          [&](const auto& k, const auto&, int q) {
            auto f = form.integrand(k);
            if (constants) f.flux = (*constants)[index][q].viscosity * f.flux;
            return f;
          });
      if (b == 0) scatter_residual<Element>(rows, pack, residual);
      if constexpr (Derivatives) scatter_blocks<Element, seeds, 0, n + 1>(rows, pack, b, blocks);
    }
  }
}

}  // namespace

template <class Element>
void ViscousLayers<Element>::add(const std::vector<WallLayer<Element>>& layers, const WallInput& in,
                                 std::vector<double>& residual, WallMatrix<n>* jacobian) {
  if (in.velocity_rate == 0) return;
  for (const auto& layer : layers) {
    if (layer.viscosity == 0) continue;
    const KelvinVoigt form = form_of(layer, in);
    for_each_thread(
        layer.packs, jacobian ? serial_jacobian_elements : serial_residual_elements, [&](int t, const auto& mine) {
          const auto constants = constants_of(layer, t);
          if (jacobian)
            viscous_packs<Element, true>(form, mine, constants, in, residual.data(), jacobian->values.data());
          else
            viscous_packs<Element, false>(form, mine, constants, in, residual.data(), nullptr);
        });
  }
}

template <class Element>
double ViscousLayers<Element>::work(const std::vector<WallLayer<Element>>& layers, const WallStep& step) {
  if (step.balance.velocity_rate == 0) return 0;
  double work = 0;
  for (const auto& layer : layers) {
    if (layer.viscosity == 0) continue;
    const KelvinVoigt form = form_of(layer, step.balance);
    const Pack rate(step.rate), duration(step.duration);
    work += sum_over_elements<1>(layer.packs, [&](const auto& pack, int thread, std::size_t index) {
      const auto constants = constants_of(layer, thread);
      ViscousPack<Element> fields;
      fields.gather_from(step.balance, step.reference, pack);
      return pack_integrals<Element, 1>(
          pack.geometry,
          [&](const auto& g) {
            return duration * form.prepare(gradient_of(fields.d, g), rate * gradient_of(fields.moved, g)).power;
          },
          [&](const Pack& power, const auto&, int q) {
            return std::array<Pack, 1>{constants ? (*constants)[index][q].viscosity * power : power};
          });
    })[0];
  }
  return work;
}

#define FSI_INSTANTIATE(Element) template struct ViscousLayers<Element>;
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
