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
    typename M::FibreData fibre{};
    if constexpr (std::is_same_v<typename M::FibreData, Fibres>) fibre = layer.fibres[thread][index];
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
    struct Prepared {
      Pack energy, stress, stabilisation;  ///< constant parts of the densities
      Pack defect;                         ///< cof F_1 : grad dd - (J_1 - J_0)
    };
    return pack_integrals<Element, 6>(
        pack.geometry,
        [&](const auto& g) {
          const Mat3<Pack> h = gradient_of(d, g), h_old = gradient_of(d_old, g), dh = h - h_old;
          const auto f = deformation(h), f_old = deformation(h_old);
          const auto strain = strain_of(f);
          const auto grad_p = gradient_of(p, g);
          Prepared k;
          k.energy = form.material.energy(strain, fibre);
          Mat3<Pack> lead = Pack(1 - radau_weight[2]) * form.isochoric_flux(f, strain, fibre);
          for (int point = 0; point < 2; ++point) {
            const auto f_between = deformation(h_old + Pack(radau_point[point]) * dh);
            const auto flux = form.isochoric_flux(f_between, strain_of(f_between), fibre);
            lead = lead - Pack(radau_weight[point]) * flux;
          }
          k.stress = contract(lead, dh);
          k.stabilisation = dot(form.stabilisation_flux(f_old, gradient_of(p_old, g), pack.geometry.size_squared) -
                                    form.stabilisation_flux(f, grad_p, pack.geometry.size_squared),
                                grad_p);
          k.defect = contract(f.cofactor_gradient, dh) - (f.volume_change - f_old.volume_change);
          return k;
        },
        [&](const Prepared& k, const auto& g) {
          const Pack pressure = value_of(p, g), dp = pressure - value_of(p_old, g);
          const Vec3<Pack> dd = value_of(d, g) - value_of(d_old, g), velocity = value_of(v, g);
          const Vec3<Pack> now = value_of(a, g), old = value_of(a_old, g);
          const Vec3<Pack> mean = Pack(in.gamma) * now + Pack(1 - in.gamma) * old;
          const Vec3<Pack> lag = Pack(1 - in.gamma) * dd + Pack((in.beta - 0.5 * in.gamma) * in.step * in.step) * mean;
          const Pack density(form.density), half_compliance(0.5 / form.bulk_modulus);
          return std::array<Pack, 6>{
              Pack(0.5) * density * dot(velocity, velocity),
              k.energy,
              half_compliance * pressure * pressure,
              density * dot(now - old, lag),
              k.stress - pressure * k.defect + half_compliance * dp * dp,
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
          const Hyperelastic<M> form{wall.density, wall.bulk_modulus, wall.stabilisation, material};
          all += detail::layer_energy(form, layer, in);
        },
        layer.material);
  return all;
}

}  // namespace fsi
