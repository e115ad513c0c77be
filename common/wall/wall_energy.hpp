#pragma once

#include "fem/element_sums.hpp"
#include "fem/interpolation.hpp"
#include "wall/wall_assembly.hpp"

namespace fsi {

namespace detail {

/// 1 / (2 kappa) at a point
template <class M>
Pack half_compliance(const Hyperelastic<M>& form, const typename Hyperelastic<M>::FibreData& at) {
  if constexpr (Hyperelastic<M>::varies)
    return Pack(0.5) / at.bulk_modulus;
  else
    return Pack(0.5 / form.bulk_modulus);
}

template <class Element, class M>
WallEnergy layer_energy(const Hyperelastic<M>& form, const WallLayer<Element>& layer, const double* wall,
                        const double* velocity, const double* balance, const double* prestress) {
  constexpr int n = Element::components;
  constexpr bool has_fibres = Hyperelastic<M>::has_fibres, is_compressible = Hyperelastic<M>::is_compressible,
                 varies = Hyperelastic<M>::varies;
  const auto integrals = [&](const auto& pack, int thread, std::size_t index) FSI_WITH_ALL_CALLS_INLINE {
    const auto fibres = points_of<Element, Hyperelastic<M>>(layer, thread);
    NodalVector<Element> d{}, v{};
    NodalScalar<Element> p{};
    gather<MixedLayout<n>>(d, pack, wall);
    if (prestress) add_prestress<Element>(d, pack, prestress);
    gather<MixedLayout<n>>(p, pack, balance);
    if (velocity) gather<VectorLayout<n>>(v, pack, velocity);
    const FieldGradients<Element> grad_d(d);
    struct Prepared {
      Strain<Pack> strain;
      Pack isotropic;       ///< Psi of materials without fibres
      Mat3<Pack> gradient;  ///< grad d where constants vary
    };
    return pack_integrals<Element, 3>(
        pack.geometry,
        [&](const auto& g) {
          Prepared k;
          if constexpr (varies) {
            k.gradient = gradient_of(grad_d, g);
          } else if constexpr (is_compressible) {
            k.isotropic = form.material.energy(gradient_of(grad_d, g));
          } else {
            k.strain = strain_of(gradient_of(grad_d, g));
            if constexpr (!has_fibres) k.isotropic = form.material.energy(k.strain, {});
          }
          return k;
        },
        [&](const Prepared& k, const auto& g, [[maybe_unused]] int q) {
          const Vec3<Pack> v_here = value_of(v, g);
          const Pack pressure = value_of(p, g);
          const auto fibre = fibres_at<Element, Hyperelastic<M>>(fibres, index, q);
          Pack isochoric = k.isotropic;
          if constexpr (varies)
            isochoric = form.material.energy(k.gradient, fibre);
          else if constexpr (has_fibres)
            isochoric = form.material.energy(k.strain, fibre);
          return std::array<Pack, 3>{
              Pack(0.5 * form.density) * dot(v_here, v_here),
              isochoric,
              half_compliance(form, fibre) * pressure * pressure,
          };
        });
  };
  const auto sums = sum_over_elements<3>(layer.packs, integrals);
  return {sums[0], sums[1], sums[2]};
}

template <class Element, class M>
WallWork layer_work(const Hyperelastic<M>& form, const WallLayer<Element>& layer, const WallStep& step) {
  constexpr int n = Element::components;
  constexpr bool has_fibres = Hyperelastic<M>::has_fibres, is_compressible = Hyperelastic<M>::is_compressible,
                 varies = Hyperelastic<M>::varies;
  using Vector = VectorLayout<n>;
  using Mixed = MixedLayout<n>;
  const Pack duration(step.duration), weight(step.weight);
  const auto integrals = [&](const auto& pack, int thread, std::size_t index) FSI_WITH_ALL_CALLS_INLINE {
    const auto fibres = points_of<Element, Hyperelastic<M>>(layer, thread);
    WallPack<Element> at;
    NodalVector<Element> reference{}, d_before{}, v_start{}, v_end{}, moved;
    NodalScalar<Element> p_before{};
    at.gather_from(step.balance, pack);
    gather<Mixed>(reference, pack, step.reference);
    if (step.wall_before) {
      gather<Mixed>(d_before, pack, step.wall_before);
      gather<Mixed>(p_before, pack, step.wall_before);
    }
    if (step.velocity_end) {
      gather<Vector>(v_start, pack, step.velocity_start);
      gather<Vector>(v_end, pack, step.velocity_end);
    }
    if (const double* prestress = step.balance.prestress) {
      add_prestress<Element>(reference, pack, prestress);
      if (step.wall_before) add_prestress<Element>(d_before, pack, prestress);
    }
    for (int a = 0; a < Element::nodes; ++a)
      for (int k = 0; k < n; ++k)
        moved.at[a][k] = Pack(step.duration * step.rate) * (at.d.at[a][k] - reference.at[a][k]);
    const FieldGradients<Element> grad_d(at.d), grad_moved(moved), grad_before(d_before);
    struct Prepared {
      Mat3<Pack> now, moved;  ///< grad d, W grad v
      decltype(deformation(Mat3<Pack>{})) f;
      Strain<Pack> strain;
      Pack isotropic;  ///< what the stress does, of materials without fibres
      Pack defect;     ///< W G : grad v - (g - g_b)
      Pack stabilisation;
    };
    return pack_integrals<Element, 3>(
        pack.geometry,
        [&](const auto& g) {
          Prepared k;
          k.now = gradient_of(grad_d, g);
          k.moved = gradient_of(grad_moved, g);
          const auto f = k.f = deformation(k.now);
          if constexpr (is_compressible) {
            const auto response = form.material.response(k.now, f);
            if constexpr (!has_fibres) k.isotropic = contract(response.flux, k.moved);
            k.defect = contract(response.volume_gradient, k.moved);
          } else {
            k.strain = strain_of(k.now, f);
            if constexpr (!has_fibres) k.isotropic = contract(form.isochoric_flux(f, k.strain, {}), k.moved);
            k.defect = contract(f.cofactor_gradient, k.moved);
          }
          k.stabilisation = Pack(0.0);
          if (step.wall_before) {
            const Mat3<Pack> h_before = gradient_of(grad_before, g);
            const auto before = deformation(h_before);
            if constexpr (is_compressible)
              k.defect = k.defect - (form.material.response(k.now, f).volume_measure -
                                     form.material.response(h_before, before).volume_measure);
            else
              k.defect = k.defect - (f.volume_change - before.volume_change);
            if constexpr (Element::stabilised) {
              const auto grad_p = gradient_of(at.p, g);
              const auto& here = in_pack(form, fibres, index);
              k.stabilisation =
                  dot(here.stabilisation_flux(before, gradient_of(p_before, g), pack.geometry.size_squared) -
                          here.stabilisation_flux(f, grad_p, pack.geometry.size_squared),
                      grad_p);
            }
          }
          return k;
        },
        [&](const Prepared& k, const auto& g, [[maybe_unused]] int q) {
          const auto fibre = fibres_at<Element, Hyperelastic<M>>(fibres, index, q);
          Pack of_stress = k.isotropic;
          if constexpr (varies)
            of_stress = contract(form.material.response(k.now, k.f, fibre).flux, k.moved);
          else if constexpr (has_fibres)
            of_stress = contract(form.isochoric_flux(k.f, k.strain, fibre), k.moved);
          const Pack pressure = value_of(at.p, g);
          of_stress = of_stress - pressure * k.defect;
          if (step.wall_before) {
            const Pack dp = pressure - value_of(p_before, g);
            of_stress += half_compliance(form, fibre) * dp * dp;
          }
          // Differences first: W a . v - omega (|v_1|^2 - |v_0|^2) / 2 free of cancellation
          const Vec3<Pack> v0 = value_of(v_start, g), v1 = value_of(v_end, g), change = weight * (v1 - v0);
          const Vec3<Pack> v = Pack(step.rate) * (value_of(at.d, g) - value_of(reference, g));
          const Pack inertia =
              dot(duration * value_of(at.acceleration, g) - change, v) + Pack(0.5) * dot(change, (v - v0) - (v1 - v));
          return std::array<Pack, 3>{Pack(form.density) * inertia, of_stress, k.stabilisation};
        });
  };
  const auto sums = sum_over_elements<3>(layer.packs, integrals);
  return {sums[0], sums[1], sums[2]};
}

/// Calls visit(form, layer) for each layer.
template <class Element, class Visit>
void for_each_layer(const WallConstants& wall, const std::vector<WallLayer<Element>>& layers, Visit visit) {
  for (const auto& layer : layers) {
    std::visit(
        [&](const auto& law) {
          using M = std::decay_t<decltype(law)>;
          visit(Hyperelastic<M>{wall.density, bulk_modulus(layer.material, wall.bulk_modulus), wall.stabilisation, law,
                                wall.wave_speed},
                layer);
        },
        layer.element_law());
  }
}

}  // namespace detail

/// \param wall      (d, .) of a level
/// \param velocity  of the level, vector layout; null in statics
/// \param balance   (., p) of the balance whose pressures are to count
/// \param prestress  as in WallInput
template <class Element>
WallEnergy wall_energy(const WallConstants& constants, const std::vector<WallLayer<Element>>& layers,
                       const double* wall, const double* velocity, const double* balance,
                       const double* prestress = nullptr) {
  WallEnergy all;
  detail::for_each_layer(constants, layers, [&](const auto& form, const auto& layer) {
    using M = std::decay_t<decltype(form.material)>;
    if constexpr (compiled_apart<M>)
      all += LayerLoops<Element, M>::energy(form, layer, wall, velocity, balance, prestress);
    else
      all += detail::layer_energy(form, layer, wall, velocity, balance, prestress);
  });
  return all;
}

/// Of one balance of a step.
template <class Element>
WallWork wall_work(const WallConstants& constants, const std::vector<WallLayer<Element>>& layers,
                   const WallStep& step) {
  WallWork all;
  detail::for_each_layer(constants, layers, [&](const auto& form, const auto& layer) {
    using M = std::decay_t<decltype(form.material)>;
    if constexpr (compiled_apart<M>)
      all += LayerLoops<Element, M>::work(form, layer, step);
    else
      all += detail::layer_work(form, layer, step);
  });
  return all;
}

}  // namespace fsi
