#pragma once

#include <vector>

#include "algebra/block_matrix.hpp"
#include "fem/assembly_result.hpp"
#include "fem/contributions.hpp"
#include "fem/element_packs.hpp"
#include "fluid/ale_fluid.hpp"

namespace fsi {

/// Nodal fields the fluid's residual depends on. Flow arrays hold (u, p), components + 1 numbers per node, in mm/ms and
/// kPa; mesh arrays the displacement d_m, `components` numbers per node, in mm. The latter are null where the domain is
/// rigid.
struct FluidInput {
  const double* mesh = nullptr;
  const double* mesh_old = nullptr;  ///< of the previous time level
  const double* flow = nullptr;
  const double* flow_old = nullptr;
};

/// Derivatives of the fluid's residual with respect to its own unknowns (u, p) and to the mesh displacement.
template <class Element>
struct FluidJacobian {
  static constexpr int own = Element::components + 1;
  BlockMatrix<own, own> flow;                         ///< columns (u, p)
  BlockMatrix<own, Element::components> mesh_motion;  ///< columns d_m: shape derivatives; empty where not asked for
};

/// Which derivatives an element loop is asked for.
enum class FluidDerivatives { none, flow, flow_and_domain };

namespace detail {

template <class Element, FluidDerivatives Derivatives, bool Moving>
AssemblyResult fluid_packs(const AleFluid& form, const std::vector<typename ElementPacks<Element>::ElementPack>& packs,
                           const FluidInput& in, double* residual, FluidJacobian<Element>* jacobian) {
  constexpr int n = Element::components;
  constexpr bool domain = Derivatives == FluidDerivatives::flow_and_domain;
  // Seeds of one node, in this order: mesh displacement (if asked for), velocity, pressure.
  constexpr int seeds = Derivatives == FluidDerivatives::none ? 0 : (domain ? 2 * n + 1 : n + 1);
  constexpr int domain_seeds = domain ? seeds : 0;
  constexpr int u0 = domain ? n : 0, p0 = u0 + n;
  using T = Seeded<seeds>;

  AssemblyResult result;
  const double per_step = 1.0 / form.step;
  NodalVector<Element> d{}, d_old{}, u{}, u_old{}, rate{}, convection{};
  NodalScalar<Element> p{};
  ElementRows<Element, T> rows;
  for (const auto& pack : packs) {
    gather(u, pack, in.flow, n + 1);
    gather(u_old, pack, in.flow_old, n + 1);
    gather(p, pack, in.flow + n, n + 1);
    if constexpr (Moving) {
      gather(d, pack, in.mesh);
      gather(d_old, pack, in.mesh_old);
    }
    for (int a = 0; a < Element::nodes; ++a)
      for (int k = 0; k < n; ++k) {
        rate.at[a][k] = Pack(per_step) * (u.at[a][k] - u_old.at[a][k]);
        convection.at[a][k] = u.at[a][k];
        if constexpr (Moving) convection.at[a][k] -= Pack(per_step) * (d.at[a][k] - d_old.at[a][k]);
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
              for (int i = 0; i < n; ++i) c[Element::axis[i]].slope[i] = Pack(-per_step * g.shape[b]);
            return form.integrand(k, seed_value<Element, seeds, u0>(value_of(rate, g), g, b, per_step), c,
                                  seed_value<Element, seeds, p0>(value_of(p, g), g, b));
          });
      if (b == 0) scatter_residual<Element>(rows, pack, residual);
      if constexpr (seeds > 0) scatter_blocks<Element, seeds, u0, n + 1>(rows, pack, b, jacobian->flow.values.data());
      if constexpr (domain) scatter_blocks<Element, seeds, 0, n>(rows, pack, b, jacobian->mesh_motion.values.data());
    }
  }
  return result;
}

}  // namespace detail

/// Adds the fluid's residual, components + 1 rows per node (momentum, continuity), without boundary conditions, and
/// overwrites the derivatives asked for.
template <class Element>
AssemblyResult assemble_fluid(const AleFluid& form, const ElementPacks<Element>& packs, const FluidInput& in,
                              std::vector<double>& residual, FluidDerivatives derivatives = FluidDerivatives::none,
                              FluidJacobian<Element>* jacobian = nullptr) {
  if (derivatives != FluidDerivatives::none) jacobian->flow.set_zero();
  if (derivatives == FluidDerivatives::flow_and_domain) jacobian->mesh_motion.set_zero();
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
    if (derivatives == D::flow) with(std::integral_constant<D, D::flow>{});
    if (derivatives == D::flow_and_domain) run(std::integral_constant<D, D::flow_and_domain>{}, std::true_type{});
  });
  return reduced(results);
}

}  // namespace fsi
