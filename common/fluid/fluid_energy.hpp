#pragma once

#include "fem/element_sums.hpp"
#include "fem/interpolation.hpp"
#include "fluid/fluid_assembly.hpp"

namespace fsi {

namespace detail {

template <class Element>
struct PreparedEnergy {
  AleFluid::Prepared<MetricOf<Element>, Pack, Pack> form;
  Pack volume_step;  ///< J_1 - J_0
  Pack defect;       ///< D - (J_1 - J_0), D = dt J div w
};

}  // namespace detail

/// \param in  of a step by backward Euler, whose references are the last level
template <class Element>
FluidEnergy fluid_energy(AleFluid form, const ElementPacks<Element>& packs, const FluidInput& in) {
  constexpr int n = Element::components;
  using Vector = VectorLayout<n>;
  using Mixed = MixedLayout<n>;
  form.step = in.step;
  const auto integrals = [&](const auto& pack, int, std::size_t) {
    NodalVector<Element> d{}, d_old{}, u{}, u_old{}, rate, convection, projected{};
    NodalScalar<Element> p{};
    gather<Mixed>(u, pack, in.fluid);
    gather<Mixed>(u_old, pack, in.fluid_reference);
    gather<Mixed>(p, pack, in.fluid);
    if (in.projected_gradient) gather<Vector>(projected, pack, in.projected_gradient);
    if (in.mesh) {
      gather<Vector>(d, pack, in.mesh);
      gather<Vector>(d_old, pack, in.mesh_reference);
    }
    for (int a = 0; a < Element::nodes; ++a)
      for (int k = 0; k < n; ++k) {
        rate.at[a][k] = Pack(in.fluid_factor) * (u.at[a][k] - u_old.at[a][k]);
        convection.at[a][k] = u.at[a][k] - Pack(in.mesh_factor) * (d.at[a][k] - d_old.at[a][k]);
      }
    return pack_integrals<Element, 7>(
        pack.geometry,
        [&](const auto& g) {
          detail::PreparedEnergy<Element> k;
          const Mat3<Pack> h = gradient_of(d, g), h_old = gradient_of(d_old, g);
          k.form = form.prepare(h, gradient_of(u, g), gradient_of(p, g), pack.geometry.metric);
          k.volume_step = volume_change(h) - volume_change(h_old);
          k.defect = contract(k.form.cofactor_gradient, h - h_old) - k.volume_step;
          return k;
        },
        [&](const detail::PreparedEnergy<Element>& k, const auto& g, int) {
          const Vec3<Pack> now = value_of(u, g), old = value_of(u_old, g), step = now - old;
          const Vec3<Pack> c = value_of(convection, g);
          const auto power = form.power(k.form, value_of(rate, g), c, value_of(projected, g));
          const Pack half_density(0.5 * form.density), square = dot(now, now);
          const Pack volume = half_density * k.form.volume_ratio;
          const Pack divergence = Pack(form.step) * volume * k.form.divergence * square;
          const Pack mesh_divergence = half_density * (k.defect + k.volume_step) * square;
          return std::array<Pack, 7>{
              volume * square,
              Pack(form.step) * power.viscous,
              Pack(form.step) * power.stabilisation,
              volume * dot(step, step),
              half_density * (k.defect * square + k.volume_step * (square - dot(old, old))),
              -divergence,
              Pack(2 * form.step) * volume * dot(k.form.velocity_gradient * c, now) + divergence - mesh_divergence,
          };
        });
  };
  const auto sums = sum_over_elements<7>(packs, integrals);
  return {sums[0], sums[1], sums[2], sums[3], sums[4], sums[5], sums[6]};
}

}  // namespace fsi
