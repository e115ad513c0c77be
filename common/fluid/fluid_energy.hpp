#pragma once

#include "fem/element_sums.hpp"
#include "fem/interpolation.hpp"
#include "fluid/fluid_assembly.hpp"
#include "fluid/shear_dependent_loops.hpp"

namespace fsi {

namespace detail {

template <class Element, class Form>
struct PreparedWork {
  typename Form::template Prepared<MetricOf<Element>, Pack, Pack> form;
  Pack since_start;      ///< J - J_0
  Pack to_end;           ///< J_1 - J
  Pack end_ratio;        ///< J_1
  Pack mesh_divergence;  ///< D = W cof F : grad w
};

/// fluid_work() of one kind of fluid.
template <class Element, class Form>
FluidWork work_of_form(Form form, const ElementPacks<Element>& packs, const FluidStep& step) {
  constexpr int n = Element::components;
  using Vector = VectorLayout<n>;
  using Mixed = MixedLayout<n>;
  const FluidInput& in = step.balance;
  form.step = in.step;
  const Pack duration(step.duration), weight(step.weight);
  const auto integrals = [&](const auto& pack, int, std::size_t) FSI_WITH_ALL_CALLS_INLINE {
    NodalVector<Element> d_start{}, d_end{}, u_start{}, u_end{};
    detail::FluidPack<Element> at;
    if (in.mesh) {
      at.template gather_from<true>(in, pack);
      gather<Vector>(d_start, pack, step.mesh_start);
      gather<Vector>(d_end, pack, step.mesh_end);
    } else {
      at.template gather_from<false>(in, pack);
    }
    gather<Mixed>(u_start, pack, step.fluid_start);
    gather<Mixed>(u_end, pack, step.fluid_end);
    const FieldGradients<Element> grad_d(at.d), grad_reference(at.d_reference), grad_u(at.u), grad_start(d_start),
        grad_end(d_end);
    return pack_integrals<Element, 7>(
        pack.geometry,
        [&](const auto& g) {
          PreparedWork<Element, Form> k;
          const Mat3<Pack> h = gradient_of(grad_d, g);
          k.form = form.prepare(h, gradient_of(grad_u, g), gradient_of(at.p, g), pack.geometry.metric);
          const Pack change = volume_change(h);
          k.since_start = change - volume_change(gradient_of(grad_start, g));
          const Pack end_change = volume_change(gradient_of(grad_end, g));
          k.to_end = end_change - change;
          k.end_ratio = end_change + 1.0;
          k.mesh_divergence =
              duration * Pack(in.mesh_factor) * contract(k.form.cofactor_gradient, h - gradient_of(grad_reference, g));
          return k;
        },
        [&](const PreparedWork<Element, Form>& k, const auto& g, int) {
          const Vec3<Pack> u = value_of(at.u, g), u0 = value_of(u_start, g), u1 = value_of(u_end, g);
          const Vec3<Pack> rate = value_of(at.rate, g), c = value_of(at.convection, g);
          const auto power = form.power(k.form, rate, c, value_of(at.projected, g));
          const Pack half_density(0.5 * form.density), square = dot(u, u);
          const Pack volume = half_density * k.form.volume_ratio;
          const Pack divergence = duration * volume * k.form.divergence * square;
          const Pack mesh_divergence = half_density * k.mesh_divergence * square;
          // Differences first: W du/dt . u - omega (|u_1|^2 - |u_0|^2) / 2 free of cancellation
          const Vec3<Pack> change = weight * (u1 - u0);
          const Pack inertia = Pack(2.0) * dot(duration * rate - change, u) + dot(change, (u - u0) - (u1 - u));
          return std::array<Pack, 7>{
              duration * power.viscous,
              duration * power.stabilisation,
              volume * inertia,
              mesh_divergence - half_density * weight * (k.to_end * dot(u1, u1) + k.since_start * dot(u0, u0)),
              -divergence,
              Pack(2.0) * duration * volume * dot(k.form.velocity_gradient * c, u) + divergence - mesh_divergence,
              half_density * k.end_ratio * dot(u1, u1),
          };
        });
  };
  const auto sums = sum_over_elements<7>(packs, integrals);
  FluidWork work;
  work.viscous = sums[0];
  work.stabilisation = sums[1];
  work.inertia = sums[2];
  work.mesh_motion = sums[3];
  work.divergence = sums[4];
  work.convection = sums[5];
  work.kinetic_end = sums[6];
  return work;
}

}  // namespace detail

/// The work of one balance of a step, uJ, but for FluidWork::backflow. Over the elements that this process counts.
/// \param step  its balance with the projected gradient, where the stabilisation has one (Fluid::projected())
template <class Element>
FluidWork fluid_work(const AleFluid& form, const ElementPacks<Element>& packs, const FluidStep& step) {
  return form.law ? ShearDependentLoops<Element>::work({form}, packs, step) : detail::work_of_form(form, packs, step);
}

}  // namespace fsi
