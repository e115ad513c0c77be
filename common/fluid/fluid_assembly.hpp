#pragma once

#include <vector>

#include "fem/assembly_result.hpp"
#include "fem/contributions.hpp"
#include "fem/element_packs.hpp"
#include "fluid/ale_fluid.hpp"
#include "fluid/fluid_input.hpp"

namespace fsi {

namespace detail {

template <class Element, FluidDerivatives Derivatives, bool Moving>
AssemblyResult fluid_packs(const AleFluid& form, const std::vector<typename ElementPacks<Element>::ElementPack>& packs,
                           const FluidInput& in, double* residual, FluidJacobian<Element::components>* jacobian) {
  constexpr int n = Element::components;
  constexpr bool domain = Derivatives == FluidDerivatives::fluid_and_domain;
  // Seeds of one node, in this order: mesh displacement (if asked for), velocity, pressure.
  constexpr int seeds = Derivatives == FluidDerivatives::none ? 0 : (domain ? 2 * n + 1 : n + 1);
  constexpr int domain_seeds = domain ? seeds : 0;
  constexpr int u0 = domain ? n : 0, p0 = u0 + n;
  using T = Seeded<seeds>;

  AssemblyResult result;
  using Vector = VectorLayout<n>;
  using Mixed = MixedLayout<n>;
  NodalVector<Element> d{}, d_reference{}, u{}, u_reference{}, rate{}, convection{}, projected{};
  NodalScalar<Element> p{};
  ElementRows<Element, T> rows;
  for (const auto& pack : packs) {
    gather<Mixed>(u, pack, in.fluid);
    gather<Mixed>(u_reference, pack, in.fluid_reference);
    gather<Mixed>(p, pack, in.fluid);
    if (in.projected_gradient) gather<Vector>(projected, pack, in.projected_gradient);
    if constexpr (Moving) {
      gather<Vector>(d, pack, in.mesh);
      gather<Vector>(d_reference, pack, in.mesh_reference);
    }
    for (int a = 0; a < Element::nodes; ++a)
      for (int k = 0; k < n; ++k) {
        rate.at[a][k] = Pack(in.fluid_factor) * (u.at[a][k] - u_reference.at[a][k]);
        convection.at[a][k] = u.at[a][k];
        if constexpr (Moving) convection.at[a][k] -= Pack(in.mesh_factor) * (d.at[a][k] - d_reference.at[a][k]);
      }

    constexpr int passes = seeds == 0 ? 1 : Element::nodes;  // derivatives: the unknowns of one node at a time
    for (int b = 0; b < passes; ++b) {
      integrate(
          rows, pack.geometry,
          [&](const auto& g) {
            const auto k =
                form.prepare(seed_gradient<Element, domain_seeds, 0>(gradient_of(d, g), g, b),
                             seed_gradient<Element, seeds, u0>(gradient_of(u, g), g, b),
                             seed_gradient<Element, seeds, p0>(gradient_of(p, g), g, b), pack.geometry.metric);
            if (b == 0) result.include(value_of(k.volume_ratio), pack.cell.data());
            return k;
          },
          [&](const auto& k, const auto& g, int) {
            Vec3<T> c = seed_value<Element, seeds, u0>(value_of(convection, g), g, b);
            if constexpr (domain)
              for (int i = 0; i < n; ++i) c[Element::axis[i]].slope[i] = Pack(-in.mesh_factor * g.vectors().value[b]);
            return form.integrand(k, seed_value<Element, seeds, u0>(value_of(rate, g), g, b, in.fluid_factor), c,
                                  seed_value<Element, seeds, p0>(value_of(p, g), g, b), value_of(projected, g));
          });
      if (b == 0) scatter_residual<Element>(rows, pack, residual);
      if constexpr (seeds > 0)
        scatter_blocks<Element, seeds, u0, Mixed::entries>(rows, pack, b, jacobian->fluid.values.data());
      if constexpr (domain)
        scatter_blocks<Element, seeds, 0, n>(rows, pack, b, jacobian->shape_derivatives.values.data());
    }
  }
  return result;
}

}  // namespace detail

/// Adds the fluid's residual (momentum, continuity) in the mixed layout, without boundary conditions, and overwrites
/// the derivatives asked for.
template <class Element>
AssemblyResult assemble_fluid(AleFluid form, const ElementPacks<Element>& packs, const FluidInput& in,
                              std::vector<double>& residual, FluidDerivatives derivatives = FluidDerivatives::none,
                              FluidJacobian<Element::components>* jacobian = nullptr) {
  form.step = in.step;
  if (derivatives != FluidDerivatives::none) jacobian->fluid.set_zero();
  if (derivatives == FluidDerivatives::fluid_and_domain) jacobian->shape_derivatives.set_zero();
  std::vector<AssemblyResult> results(packs.thread_count());
  const auto serial_below = derivatives == FluidDerivatives::none ? serial_residual_elements : serial_jacobian_elements;
  for_each_thread(packs, serial_below, [&](int t, const auto& mine) {
    using D = FluidDerivatives;
    const auto run = [&](auto which, auto moving) {
      results[t] = detail::fluid_packs<Element, decltype(which)::value, decltype(moving)::value>(
          form, mine, in, residual.data(), jacobian);
    };
    const auto with = [&](auto which) { in.mesh ? run(which, std::true_type{}) : run(which, std::false_type{}); };
    if (derivatives == D::none) with(std::integral_constant<D, D::none>{});
    if (derivatives == D::fluid) with(std::integral_constant<D, D::fluid>{});
    if (derivatives == D::fluid_and_domain) run(std::integral_constant<D, D::fluid_and_domain>{}, std::true_type{});
  });
  return reduced(results);
}

}  // namespace fsi
