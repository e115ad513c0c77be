#pragma once

#include <cassert>
#include <type_traits>
#include <variant>
#include <vector>

#include "fem/assembly_result.hpp"
#include "fem/contributions.hpp"
#include "fem/element_packs.hpp"
#include "fem/point_tangents.hpp"
#include "wall/hyperelastic.hpp"
#include "wall/layer_loops.hpp"
#include "wall/wall_input.hpp"

namespace fsi {

namespace detail {

/// What a form is told of the points of all packs: the constants where they vary, else the fibres; null where it needs
/// none.
template <class Element, class Form>
using LayerPoints = const std::vector<
    std::array<std::conditional_t<std::is_same_v<typename Form::FibreData, PointConstants>, PointConstants, Fibres>,
               Element::points>>*;

template <class Element, class Form>
LayerPoints<Element, Form> points_of(const WallLayer<Element>& layer, int thread) {
  if constexpr (std::is_same_v<typename Form::FibreData, PointConstants>)
    return &layer.constants[thread];
  else
    return layer.fibres.empty() ? nullptr : &layer.fibres[thread];
}

/// A form's fibres at point q of a pack.
template <class Element, class Form>
typename Form::FibreData fibres_at(LayerPoints<Element, Form> fibres, std::size_t pack, int q) {
  if constexpr (!std::is_same_v<typename Form::FibreData, NoFibres>) {
    assert(fibres);
    return (*fibres)[pack][q];
  } else {
    return {};
  }
}

/// Makes displacements of one pack from the mesh those from the unloaded shape. Not inlined: most walls have no prestress,
/// and their loops are to stay as they are, to the last bit.
template <class Element>
[[gnu::noinline]] void add_prestress(NodalVector<Element>& to, const typename ElementPacks<Element>::ElementPack& pack,
                                     const double* prestress) {
  NodalVector<Element> first{};
  gather<VectorLayout<Element::components>>(first, pack, prestress);
  for (int a = 0; a < Element::nodes; ++a)
    for (int k = 0; k < Element::components; ++k) to.at[a][k] += first.at[a][k];
}

/// The fields that the wall's weak form sees, in one pack.
template <class Element>
struct WallPack {
  NodalVector<Element> d{}, acceleration{};
  NodalScalar<Element> p{};

  void gather_from(const WallInput& in, const typename ElementPacks<Element>::ElementPack& pack) {
    constexpr int n = Element::components;
    gather<MixedLayout<n>>(d, pack, in.wall);
    gather<MixedLayout<n>>(p, pack, in.wall);
    if (in.acceleration_history) {
      gather<VectorLayout<n>>(acceleration, pack, in.acceleration_history);
      for (int a = 0; a < Element::nodes; ++a)
        for (int k = 0; k < n; ++k) acceleration.at[a][k] += Pack(in.acceleration_factor) * d.at[a][k];
    }
    if (in.prestress) add_prestress<Element>(d, pack, in.prestress);
  }
};

/// Residual and, by seeding one node after the other, derivatives.
template <class Element, bool Derivatives, class Form>
AssemblyResult layer_packs(const Form& form, const std::vector<typename ElementPacks<Element>::ElementPack>& packs,
                           LayerPoints<Element, Form> fibres, const WallInput& in, double* residual, double* blocks) {
  constexpr int n = Element::components;
  using Mixed = MixedLayout<n>;
  constexpr int seeds = Derivatives ? n + 1 : 0;  // displacement, pressure
  using T = Seeded<seeds>;

  AssemblyResult result;
  WallPack<Element> fields;
  const auto &d = fields.d, &acceleration = fields.acceleration;
  const auto& p = fields.p;
  ElementRows<Element, T> rows;
  for (std::size_t index = 0; index < packs.size(); ++index) {
    const auto& pack = packs[index];
    fields.gather_from(in, pack);
    const FieldGradients<Element> grad_d(d);
    const auto& here = in_pack(form, fibres, index);
    for (int b = 0; b < (Derivatives ? Element::nodes : 1); ++b) {
      integrate(
          rows, pack.geometry,
          [&](const auto& g) {
            const auto k =
                here.prepare(seed_gradient<Element, seeds, 0>(gradient_of(grad_d, g), g, b),
                             seed_gradient<Element, seeds, n>(gradient_of(p, g), g, b), pack.geometry.size_squared);
            if (b == 0) result.include(value_of(k.volume_ratio), pack.cell.data());
            return k;
          },
          [&](const auto& k, const auto& g, int q) {
            return here.integrand(
                k, seed_value<Element, seeds, 0>(value_of(acceleration, g), g, b, in.acceleration_factor),
                seed_value<Element, seeds, n>(value_of(p, g), g, b), fibres_at<Element, Form>(fibres, index, q));
          });
      if (b == 0) scatter_residual<Element>(rows, pack, residual);
      if constexpr (Derivatives) scatter_blocks<Element, seeds, 0, Mixed::entries>(rows, pack, b, blocks);
    }
  }
  return result;
}

/// Residual and derivatives by way of the points' tangents (fem/point_tangents.hpp), for elements without
/// stabilisation.
template <class Element, class Form>
AssemblyResult layer_packs_by_points(const Form& form,
                                     const std::vector<typename ElementPacks<Element>::ElementPack>& packs,
                                     LayerPoints<Element, Form> fibres, const WallInput& in, double* residual,
                                     double* blocks) {
  constexpr int n = Element::components, columns = n + 1;  // of a node: d, p
  QuadraturePoint<Element> g;
  VectorTangent<Element> by_displacement;
  ScalarTangent<Element> by_pressure;

  AssemblyResult result;
  WallPack<Element> fields;
  ElementRows<Element, Pack> values;
  NodeColumns<Element, columns> derivatives;
  for (std::size_t index = 0; index < packs.size(); ++index) {
    const auto& pack = packs[index];
    fields.gather_from(in, pack);
    values.set_zero();
    for (int q = 0; q < Element::points; ++q) {
      g = Element::at(pack.geometry, q);
      const Mat3<Pack> grad_d = gradient_of(fields.d, g);
      const Vec3<Pack> acceleration = value_of(fields.acceleration, g);
      const Pack p = value_of(fields.p, g);
      const auto fibres_here = fibres_at<Element, Form>(fibres, index, q);
      const auto k = form.prepare(grad_d, Vec3<Pack>{}, Unstabilised{});
      result.include(k.volume_ratio, pack.cell.data());
      for (int i = 0; i < n; ++i) {
        const auto seeded = form.prepare(seed_gradient_of<Element>(i, grad_d, g), Vec3<Dual<gradient_seeds<Element>>>{},
                                         Unstabilised{});
        by_displacement.set_gradient(i, form.integrand(seeded, acceleration, p, fibres_here), g, q);
      }
      const auto f = form.integrand(k, seed_components<Element>(acceleration, in.acceleration_factor), seed_scalar(p),
                                    fibres_here);
      by_displacement.add_values(f.source, g, q);
      by_pressure.set(f, g, q);
      values.add_sources(value_of(f), g);
      values.add_fluxes(value_of(f), g, g.weight);
    }
    scatter_residual<Element>(values, pack, residual);
    by_displacement.sum();
    by_pressure.sum();
    for (int b = 0; b < Element::nodes; ++b) {
      set_vector_columns<0>(derivatives, by_displacement, b);
      set_scalar_column<n>(derivatives, by_pressure, b);
      scatter_columns<0, columns>(derivatives, pack, b, blocks);
    }
  }
  return result;
}

/// One layer's share of assemble_wall(). \tparam WithResidualLoop  false: there is always a Jacobian
template <class Element, bool WithResidualLoop = true, class Form>
AssemblyResult assemble_layer(const Form& form, const WallLayer<Element>& layer, const WallInput& in,
                              std::vector<double>& residual, WallMatrix<Element::components>* jacobian) {
  std::vector<AssemblyResult> results(layer.packs.thread_count());
  const auto serial_below = jacobian ? serial_jacobian_elements : serial_residual_elements;
  for_each_thread(layer.packs, serial_below, [&](int t, const auto& mine) {
    const auto fibres = points_of<Element, Form>(layer, t);
    double* rows = residual.data();
    if constexpr (WithResidualLoop)
      if (!jacobian) {
        results[t] = layer_packs<Element, false>(form, mine, fibres, in, rows, nullptr);
        return;
      }
    assert(jacobian);
    if constexpr (Element::stabilised) {
      results[t] = layer_packs<Element, true>(form, mine, fibres, in, rows, jacobian->values.data());
    } else {
      results[t] = layer_packs_by_points<Element>(form, mine, fibres, in, rows, jacobian->values.data());
    }
  });
  return reduced(results);
}

}  // namespace detail

/// Adds the wall's residual (momentum, volume) in the mixed layout, without boundary conditions, and overwrites the
/// Jacobian if one is passed, which it must be for the unloaded shape.
template <class Element>
AssemblyResult assemble_wall(const WallConstants& wall, const std::vector<WallLayer<Element>>& layers,
                             const WallInput& in, std::vector<double>& residual,
                             WallMatrix<Element::components>* jacobian = nullptr) {
  if (jacobian) jacobian->set_zero();
  AssemblyResult all;
  for (const auto& layer : layers) {
    std::visit(
        [&](const auto& law) {
          using M = std::decay_t<decltype(law)>;
          const Hyperelastic<M> form{in.acceleration_history ? wall.density : 0.0,
                                     bulk_modulus(layer.material, wall.bulk_modulus), wall.stabilisation, law,
                                     wall.wave_speed};
          if (in.finds_unloaded_shape)
            all.include(UnloadedLoops<Element, M>::assemble(form, layer, in, residual, jacobian));
          else if constexpr (compiled_apart<M>)
            all.include(LayerLoops<Element, M>::assemble(form, layer, in, residual, jacobian));
          else
            all.include(detail::assemble_layer(form, layer, in, residual, jacobian));
        },
        layer.element_law());
  }
  return all;
}

}  // namespace fsi
