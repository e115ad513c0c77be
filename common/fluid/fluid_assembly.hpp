#pragma once

#include <vector>

#include "fem/assembly_result.hpp"
#include "fem/contributions.hpp"
#include "fem/element_packs.hpp"
#include "fem/point_tangents.hpp"
#include "fluid/ale_fluid.hpp"
#include "fluid/fluid_input.hpp"
#include "fluid/shear_dependent_loops.hpp"

namespace fsi {

namespace detail {

/// The fields that the fluid's weak form sees, in one pack.
template <class Element>
struct FluidPack {
  static constexpr int n = Element::components;
  NodalVector<Element> d{}, d_reference{}, u{}, u_reference{}, rate{}, convection{}, projected{};
  NodalScalar<Element> p{};

  template <bool Moving>
  void gather_from(const FluidInput& in, const typename ElementPacks<Element>::ElementPack& pack) {
    using Vector = VectorLayout<n>;
    using Mixed = MixedLayout<n>;
    gather<Mixed>(u, pack, in.fluid);
    gather<Mixed>(u_reference, pack, in.fluid_reference);
    gather<Mixed>(p, pack, in.fluid);
    if constexpr (Element::stabilised)
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
  }
};

/// Residual and, by seeding one node after the other, derivatives: first with respect to its velocity and pressure, then
/// to its mesh displacement. Seeded together each would carry the other's slopes, most of which are zero.
template <class Element, FluidDerivatives Derivatives, bool Moving, class Form>
AssemblyResult fluid_packs(const Form& form, const std::vector<typename ElementPacks<Element>::ElementPack>& packs,
                           const FluidInput& in, double* residual, FluidJacobian<Element::components>* jacobian) {
  constexpr int n = Element::components;
  constexpr bool domain = Derivatives == FluidDerivatives::fluid_and_domain;
  constexpr int seeds = Derivatives == FluidDerivatives::none ? 0 : n + 1;

  AssemblyResult result;
  using Mixed = MixedLayout<n>;
  FluidPack<Element> fields;
  const auto &d = fields.d, &u = fields.u, &rate = fields.rate, &convection = fields.convection,
             &projected = fields.projected;
  const auto& p = fields.p;
  ElementRows<Element, Seeded<seeds>> rows;
  for (const auto& pack : packs) {
    fields.template gather_from<Moving>(in, pack);
    const FieldGradients<Element> grad_d(d), grad_u(u);
    constexpr int passes = seeds == 0 ? 1 : Element::nodes;  // derivatives: the unknowns of one node at a time
    for (int b = 0; b < passes; ++b) {
      integrate(
          rows, pack.geometry,
          [&](const auto& g) {
            const auto k =
                form.prepare(gradient_of(grad_d, g), seed_gradient<Element, seeds, 0>(gradient_of(grad_u, g), g, b),
                             seed_gradient<Element, seeds, n>(gradient_of(p, g), g, b), pack.geometry.metric);
            if (b == 0) result.include(value_of(k.volume_ratio), pack.cell.data());
            return k;
          },
          [&](const auto& k, const auto& g, int) {
            return form.integrand(k, seed_value<Element, seeds, 0>(value_of(rate, g), g, b, in.fluid_factor),
                                  seed_value<Element, seeds, 0>(value_of(convection, g), g, b),
                                  seed_value<Element, seeds, n>(value_of(p, g), g, b), value_of(projected, g));
          });
      if (b == 0) scatter_residual<Element>(rows, pack, residual);
      if constexpr (seeds > 0)
        scatter_blocks<Element, seeds, 0, Mixed::entries>(rows, pack, b, jacobian->fluid.values.data());
    }
    if constexpr (domain) {
      ElementRows<Element, Dual<n>> by_domain;
      for (int b = 0; b < passes; ++b) {
        integrate(
            by_domain, pack.geometry,
            [&](const auto& g) {
              return form.prepare(seed_gradient<Element, n, 0>(gradient_of(d, g), g, b), gradient_of(u, g),
                                  gradient_of(p, g), pack.geometry.metric);
            },
            [&](const auto& k, const auto& g, int) {
              return form.integrand(k, value_of(rate, g),
                                    seed_value<Element, n, 0>(value_of(convection, g), g, b, -in.mesh_factor),
                                    value_of(p, g), value_of(projected, g));
            });
        scatter_blocks<Element, n, 0, n>(by_domain, pack, b, jacobian->shape_derivatives.values.data());
      }
    }
  }
  return result;
}

/// Residual and derivatives by way of the points' tangents (fem/point_tangents.hpp), for elements without
/// stabilisation.
template <class Element, bool Domain, bool Moving, class Form>
AssemblyResult fluid_packs_by_points(const Form& form,
                                     const std::vector<typename ElementPacks<Element>::ElementPack>& packs,
                                     const FluidInput& in, double* residual,
                                     FluidJacobian<Element::components>* jacobian) {
  constexpr int n = Element::components;
  constexpr int u0 = Domain ? n : 0, columns = u0 + n + 1;  // of a node: d_m, u, p
  QuadraturePoint<Element> g;
  VectorTangent<Element> by_velocity, by_domain;
  ScalarTangent<Element> by_pressure;

  AssemblyResult result;
  FluidPack<Element> fields;
  ElementRows<Element, Pack> values;
  NodeColumns<Element, columns> derivatives;
  for (const auto& pack : packs) {
    fields.template gather_from<Moving>(in, pack);
    values.set_zero();
    for (int q = 0; q < Element::points; ++q) {
      g = Element::at(pack.geometry, q);
      const Mat3<Pack> grad_d = gradient_of(fields.d, g), grad_u = gradient_of(fields.u, g);
      const Vec3<Pack> rate = value_of(fields.rate, g), c = value_of(fields.convection, g);
      const Pack p = value_of(fields.p, g);
      const auto prepare = [&](const auto& displacement, const auto& velocity) {
        using T = std::decay_t<decltype(velocity(0, 0))>;
        return form.prepare(displacement, velocity, Vec3<T>{}, Unstabilised{});
      };
      const auto k = prepare(grad_d, grad_u);
      result.include(k.volume_ratio, pack.cell.data());
      for (int i = 0; i < n; ++i)
        by_velocity.set_gradient(
            i, form.integrand(prepare(grad_d, seed_gradient_of<Element>(i, grad_u, g)), rate, c, p), g, q);
      by_velocity.add_values(
          form.integrand(k, seed_components<Element>(rate, in.fluid_factor), seed_components<Element>(c), p).source, g,
          q);
      const auto f = form.integrand(k, rate, c, seed_scalar(p));
      by_pressure.set(f, g, q);
      values.add_sources(value_of(f), g);
      values.add_fluxes(value_of(f), g, g.weight);
      if constexpr (Domain) {
        for (int i = 0; i < n; ++i)
          by_domain.set_gradient(
              i, form.integrand(prepare(seed_gradient_of<Element>(i, grad_d, g), grad_u), rate, c, p), g, q);
        by_domain.add_values(form.integrand(k, rate, seed_components<Element>(c, -in.mesh_factor), p).source, g, q);
      }
    }
    scatter_residual<Element>(values, pack, residual);
    by_velocity.sum();
    by_pressure.sum();
    if constexpr (Domain) by_domain.sum();
    for (int b = 0; b < Element::nodes; ++b) {
      if constexpr (Domain) set_vector_columns<0>(derivatives, by_domain, b);
      set_vector_columns<u0>(derivatives, by_velocity, b);
      set_scalar_column<u0 + n>(derivatives, by_pressure, b);
      scatter_columns<u0, n + 1>(derivatives, pack, b, jacobian->fluid.values.data());
      if constexpr (Domain) scatter_columns<0, n>(derivatives, pack, b, jacobian->shape_derivatives.values.data());
    }
  }
  return result;
}

/// assemble_fluid() of one kind of fluid.
template <class Element, class Form>
AssemblyResult assemble_form(Form form, const ElementPacks<Element>& packs, const FluidInput& in,
                             std::vector<double>& residual, FluidDerivatives derivatives,
                             FluidJacobian<Element::components>* jacobian) {
  form.step = in.step;
  if (derivatives != FluidDerivatives::none) jacobian->fluid.set_zero();
  if (derivatives == FluidDerivatives::fluid_and_domain) jacobian->shape_derivatives.set_zero();
  std::vector<AssemblyResult> results(packs.thread_count());
  const auto serial_below = derivatives == FluidDerivatives::none ? serial_residual_elements : serial_jacobian_elements;
  for_each_thread(packs, serial_below, [&](int t, const auto& mine) {
    using D = FluidDerivatives;
    const auto run = [&](auto which, auto moving) {
      constexpr D derived = decltype(which)::value;
      constexpr bool is_moving = decltype(moving)::value;
      if constexpr (Element::stabilised || derived == D::none) {
        results[t] = detail::fluid_packs<Element, derived, is_moving>(form, mine, in, residual.data(), jacobian);
      } else {
        results[t] = detail::fluid_packs_by_points<Element, derived == D::fluid_and_domain, is_moving>(
            form, mine, in, residual.data(), jacobian);
      }
    };
    const auto with = [&](auto which) { in.mesh ? run(which, std::true_type{}) : run(which, std::false_type{}); };
    if (derivatives == D::none) with(std::integral_constant<D, D::none>{});
    if (derivatives == D::fluid) with(std::integral_constant<D, D::fluid>{});
    if (derivatives == D::fluid_and_domain) run(std::integral_constant<D, D::fluid_and_domain>{}, std::true_type{});
  });
  return reduced(results);
}

}  // namespace detail

/// Adds the fluid's residual (momentum, continuity) in the mixed layout, without boundary conditions, and overwrites
/// the derivatives asked for. Those by the domain need in.mesh and in.mesh_reference.
/// \param jacobian  with storage for these derivatives; may be null where none are asked for
template <class Element>
AssemblyResult assemble_fluid(const AleFluid& form, const ElementPacks<Element>& packs, const FluidInput& in,
                              std::vector<double>& residual, FluidDerivatives derivatives = FluidDerivatives::none,
                              FluidJacobian<Element::components>* jacobian = nullptr) {
  if (form.law) return ShearDependentLoops<Element>::assemble({form}, packs, in, residual, derivatives, jacobian);
  return detail::assemble_form(form, packs, in, residual, derivatives, jacobian);
}

}  // namespace fsi
