#pragma once

#include "fem/element_sums.hpp"
#include "fem/interpolation.hpp"
#include "fluid/fluid_assembly.hpp"

namespace fsi {

/// Energy of the fluid at the end of a step, and what the step's discrete equations, tested with (u, -p), do besides
/// changing it (docs/energy.md); all in uJ = mm^3 kPa. With the step's ends 0 and 1, D = cof F_1 : grad(d_1 - d_0):
///   dt (rho J (du/dt + grad u F^-1 c), u) = kinetic_1 - kinetic_0 + inertia + mesh_motion + divergence + outflow,
/// exactly where the integration rule is for quadratic functions and the outflow that of rho/2 |u|^2 through the open
/// faces.
struct FluidEnergy {
  double kinetic = 0;        ///< (rho/2 J, |u|^2) at the end
  double viscous = 0;        ///< dt (mu J (grad u F^-1 + ...^T), grad u F^-1)
  double stabilisation = 0;  ///< dt times the power of the SUPG, PSPG and grad-div terms
  double inertia = 0;        ///< (rho/2 J, |u_1 - u_0|^2): backward Euler
  double mesh_motion = 0;    ///< rho/2 ((D, |u_1|^2) - (J_1 - J_0, |u_0|^2)): the domain's motion is not conserved
  double divergence = 0;     ///< -dt rho/2 (J div u, |u|^2): convection in convective form
};

template <class Element>
FluidEnergy fluid_energy(const AleFluid& form, const ElementPacks<Element>& packs, const FluidInput& in) {
  constexpr int n = Element::components;
  const double per_step = 1.0 / form.step;
  const auto integrals = [&](const auto& pack, int, std::size_t) {
    NodalVector<Element> d{}, d_old{}, u, u_old, rate, convection;
    NodalScalar<Element> p;
    gather(u, pack, in.flow, n + 1);
    gather(u_old, pack, in.flow_old, n + 1);
    gather(p, pack, in.flow + n, n + 1);
    if (in.mesh) {
      gather(d, pack, in.mesh);
      gather(d_old, pack, in.mesh_old);
    }
    for (int a = 0; a < Element::nodes; ++a)
      for (int k = 0; k < n; ++k) {
        rate.at[a][k] = Pack(per_step) * (u.at[a][k] - u_old.at[a][k]);
        convection.at[a][k] = u.at[a][k] - Pack(per_step) * (d.at[a][k] - d_old.at[a][k]);
      }
    struct Prepared {
      AleFluid::Prepared<Pack, Pack> form;
      Pack volume_step;  ///< J_1 - J_0
      Pack defect;       ///< D - (J_1 - J_0)
    };
    return pack_integrals<Element, 6>(
        pack.geometry,
        [&](const auto& g) {
          Prepared k;
          const Mat3<Pack> h = gradient_of(d, g), h_old = gradient_of(d_old, g);
          k.form = form.prepare(h, gradient_of(u, g), gradient_of(p, g), pack.geometry.metric);
          k.volume_step = volume_change(h) - volume_change(h_old);
          k.defect = contract(k.form.cofactor_gradient, h - h_old) - k.volume_step;
          return k;
        },
        [&](const Prepared& k, const auto& g) {
          const Vec3<Pack> now = value_of(u, g), old = value_of(u_old, g), step = now - old;
          const auto power = form.power(k.form, value_of(rate, g), value_of(convection, g));
          const Pack half_density(0.5 * form.density), square = dot(now, now);
          const Pack volume = half_density * k.form.volume_ratio;
          return std::array<Pack, 6>{
              volume * square,
              Pack(form.step) * power.viscous,
              Pack(form.step) * power.stabilisation,
              volume * dot(step, step),
              half_density * (k.defect * square + k.volume_step * (square - dot(old, old))),
              -(Pack(form.step) * volume * k.form.divergence * square),
          };
        });
  };
  const auto sums = sum_over_elements<6>(packs, integrals);
  return {sums[0], sums[1], sums[2], sums[3], sums[4], sums[5]};
}

}  // namespace fsi
