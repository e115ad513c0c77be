#pragma once

#include "fem/element_sums.hpp"
#include "fem/interpolation.hpp"
#include "wall/wall_assembly.hpp"

namespace fsi {

namespace detail {

/// Radau's rule on (0, 1] with its last point at 1, exact for polynomials of degree four.
inline constexpr double radau_point[] = {0.15505102572168219018, 0.64494897427831780982};
inline constexpr double radau_weight[] = {0.37640306270046727506, 0.51248582618842161383, 1.0 / 9.0};

template <class Element, class M>
WallEnergy layer_energy(const Hyperelastic<M>& form, const WallLayer<Element>& layer, const WallStep& in) {
  constexpr int n = Element::components;
  using Vector = VectorLayout<n>;
  using Mixed = MixedLayout<n>;
  const auto integrals = [&](const auto& pack, int thread, std::size_t index) {
    const auto* fibres = layer.fibres.empty() ? nullptr : &layer.fibres[thread];
    NodalVector<Element> d{}, d_old{}, v{}, a{}, a_old{};
    NodalScalar<Element> p{}, p_old{};
    gather<Mixed>(d, pack, in.wall);
    gather<Mixed>(p, pack, in.wall);
    gather<Mixed>(d_old, pack, in.wall_old);
    gather<Mixed>(p_old, pack, in.wall_old);
    if (in.velocity) {
      gather<Vector>(v, pack, in.velocity);
      gather<Vector>(a, pack, in.acceleration);
      gather<Vector>(a_old, pack, in.acceleration_old);
    }
    struct Stress {
      Pack energy;  ///< Psi
      Pack lead;    ///< (F_1 S'_1 - mean of F S' along the step) : grad dd
    };
    struct Prepared {
      Mat3<Pack> now, old, step;  ///< grad d_1, grad d_0, grad dd
      Stress isotropic;           ///< of materials without fibres
      Pack stabilisation;
      Pack defect;  ///< cof F_1 : grad dd - (J_1 - J_0)
    };
    const auto stress = [&](const Prepared& k, const typename M::FibreData& fibre) {
      const auto f = deformation(k.now);
      const auto strain = strain_of(f);
      Mat3<Pack> lead = Pack(1 - radau_weight[2]) * form.isochoric_flux(f, strain, fibre);
      for (int point = 0; point < 2; ++point) {
        const auto f_between = deformation(k.old + Pack(radau_point[point]) * k.step);
        const auto flux = form.isochoric_flux(f_between, strain_of(f_between), fibre);
        lead = lead - Pack(radau_weight[point]) * flux;
      }
      return Stress{form.material.energy(strain, fibre), contract(lead, k.step)};
    };
    constexpr bool has_fibres = Hyperelastic<M>::has_fibres;
    return pack_integrals<Element, 6>(
        pack.geometry,
        [&](const auto& g) {
          const Mat3<Pack> h = gradient_of(d, g), h_old = gradient_of(d_old, g), dh = h - h_old;
          const auto f = deformation(h), f_old = deformation(h_old);
          Prepared k;
          k.now = h;
          k.old = h_old;
          k.step = dh;
          if constexpr (!has_fibres) k.isotropic = stress(k, {});
          k.stabilisation = Pack(0.0);
          if constexpr (Element::stabilised) {
            const auto grad_p = gradient_of(p, g);
            k.stabilisation = dot(form.stabilisation_flux(f_old, gradient_of(p_old, g), pack.geometry.size_squared) -
                                      form.stabilisation_flux(f, grad_p, pack.geometry.size_squared),
                                  grad_p);
          }
          k.defect = contract(f.cofactor_gradient, dh) - (f.volume_change - f_old.volume_change);
          return k;
        },
        [&](const Prepared& k, const auto& g, [[maybe_unused]] int q) {
          const Stress isochoric = has_fibres ? stress(k, fibres_at<Element, M>(fibres, index, q)) : k.isotropic;
          const Pack pressure = value_of(p, g), dp = pressure - value_of(p_old, g);
          const Vec3<Pack> dd = value_of(d, g) - value_of(d_old, g), velocity = value_of(v, g);
          const Vec3<Pack> now = value_of(a, g), old = value_of(a_old, g);
          const Vec3<Pack> mean = Pack(in.gamma) * now + Pack(1 - in.gamma) * old;
          const Vec3<Pack> lag = Pack(1 - in.gamma) * dd + Pack((in.beta - 0.5 * in.gamma) * in.step * in.step) * mean;
          const Pack density(form.density), half_compliance(0.5 / form.bulk_modulus);
          return std::array<Pack, 6>{
              Pack(0.5) * density * dot(velocity, velocity),
              isochoric.energy,
              half_compliance * pressure * pressure,
              density * dot(now - old, lag),
              isochoric.lead - pressure * k.defect + half_compliance * dp * dp,
              k.stabilisation,
          };
        });
  };
  const auto sums = sum_over_elements<6>(layer.packs, integrals);
  return {sums[0], sums[1], sums[2], sums[3], sums[4], sums[5]};
}

}  // namespace detail

template <class Element>
WallEnergy wall_energy(const WallConstants& wall, const std::vector<WallLayer<Element>>& layers, const WallStep& in) {
  WallEnergy all;
  for (const auto& layer : layers)
    std::visit(
        [&](const auto& material) {
          using M = std::decay_t<decltype(material)>;
          const Hyperelastic<M> form{wall.density, wall.bulk_modulus, wall.stabilisation, material, wall.wave_speed};
          all += detail::layer_energy(form, layer, in);
        },
        layer.material);
  return all;
}

}  // namespace fsi
