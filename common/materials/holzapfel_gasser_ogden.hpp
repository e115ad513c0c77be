#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "materials/parameter.hpp"
#include "materials/strain.hpp"

namespace fsi {

/// The law of Holzapfel, Gasser and Ogden with dispersed fibres ([Gasser2006]) as svMultiPhysics has it
/// (docs/theory.md, section 5.4): each family with its own constants, fibres that resist compression like extension,
///   Psi = c10/2 (J_1 - 3) + sum over i of k1_i/(2 k2_i) (exp(k2_i E_i^2) - 1),
///   E_i = kappa (J_1 - 3) + (1 - 3 kappa) (J_i - 1),  J_i = I_3^(-1/3) a_i . C a_i.
/// `artery` has this energy where E_i > 0, and no fibres elsewhere. This law is smooth: it has a tangent everywhere.
template <class Constant>
struct HolzapfelGasserOgdenOf {
  using FibreData = Fibres;
  Constant c10 = 0;         ///< kPa, initial shear modulus without fibres: twice the C_10 of others
  Constant k1 = 0;          ///< kPa, of the first family, along +alpha; at small strains its modulus is 4 k1
  Constant k2 = 0;          ///< -
  Constant k1_second = -1;  ///< of the second, along -alpha; negative: as the first, see settle()
  Constant k2_second = 0;   ///< -
  Constant kappa = 0;       ///< 0 all fibres of a family parallel, 1/3 evenly in all directions
  Constant alpha = 0;       ///< degrees between fibres and circumference; enters by the fibres' directions alone

  template <class Other>
  using with = HolzapfelGasserOgdenOf<Other>;
  static constexpr bool has_own_loops = false;
  static constexpr auto constants() {
    using Law = HolzapfelGasserOgdenOf;
    return std::array{&Law::c10, &Law::k1, &Law::k2, &Law::k1_second, &Law::k2_second, &Law::kappa};
  }

  static constexpr const char* name = "holzapfel-gasser-ogden";
  static std::vector<ParameterOf<HolzapfelGasserOgdenOf>> parameters() {
    using Law = HolzapfelGasserOgdenOf;
    const Bounds share{0, 1.0 / 3, true, true};
    return {{&Law::c10, "c10", "isotropic stiffness, the shear modulus", quantity::stiffness(), positive},
            {&Law::k1, "k1", "fibre stiffness", quantity::stiffness(), not_negative, false},
            {&Law::k2, "k2", "fibre exponent", quantity::number(), positive, false},
            {&Law::k1_second, "k1_second", "fibre stiffness of the second family", quantity::stiffness(), not_negative,
             false},
            {&Law::k2_second, "k2_second", "fibre exponent of the second family", quantity::number(), positive, false},
            {&Law::alpha, "alpha", "angle between fibres and circumference", quantity::angle(), {0, 90, true, true}},
            {&Law::kappa, "kappa", "dispersion of the fibres about their directions, at most 1/3", quantity::number(),
             share, false}};
  }
  static ParameterSets parameter_sets() { return {{"k1", "k2"}, {"k1", "k2", "k1_second", "k2_second"}}; }

  /// Both families alike unless the second has constants.
  void settle() {
    if (k1_second >= 0) return;
    k1_second = k1;
    k2_second = k2;
  }

  Constant shear_modulus() const { return c10; }
  double fibre_angle() const { return alpha * (std::acos(-1.0) / 180); }
  std::optional<double> own_bulk_modulus() const { return std::nullopt; }
  /// Two families, energy k1_i/2 E_i^2 each with E_i = (1 - 3 kappa) 2 eps cos^2(alpha) nearly.
  double fibre_stiffness() const {
    const double aligned = 1 - 3 * kappa;
    return 4 * (k1 + k1_second) * std::pow(std::cos(fibre_angle()), 4) * (aligned * aligned);
  }
  std::optional<double> inflation_modulus() const {
    return k1 > 0 || k1_second > 0 ? std::nullopt : std::optional<double>(c10);
  }

  /// With phi(x) = (exp(x) - 1) / x, phi(0) = 1: Psi = c10/2 (J_1 - 3) + sum of k1_i/2 E_i^2 phi(k2_i E_i^2)
  template <class T>
  T energy(const Strain<T>& s, const Fibres& fibres) const {
    const T spread = first_invariant_change(s);
    T psi = Pack(0.5 * c10) * spread;
    for (int i = 0; i < 2; ++i) {
      const T e = strain_of_family(spread, extension(s, fibres.direction[i])), square = e * e;
      psi += Pack(0.5 * stiffness(i)) * square * phi(Pack(exponent(i)) * square);
    }
    return psi;
  }

  /// S' = (c10 + 2 kappa sum of t_i) dJ_1/dC + 2 (1 - 3 kappa) sum of t_i dJ_i/dC, t_i = k1_i E_i exp(k2_i E_i^2)
  template <class T>
  Sym3<T> stress(const Strain<T>& s, const Fibres& fibres) const {
    const T spread = first_invariant_change(s);
    T isotropic(c10);
    Sym3<T> aligned{};
    for (int i = 0; i < 2; ++i) {
      const T stretch = extension(s, fibres.direction[i]), e = strain_of_family(spread, stretch);
      const T tension = Pack(2.0 * stiffness(i)) * exp(Pack(exponent(i)) * e * e) * e;
      isotropic += Pack(kappa) * tension;
      const T along = Pack(1.0 - 3.0 * kappa) * tension, third = (stretch + 1.0) * Pack(1.0 / 3.0);  // J_i / 3
      const Sym3<Pack> aa = dyad(fibres.direction[i]);
      for (int k = 0; k < 6; ++k)
        aligned.c[k] +=
            along * (s.isochoric * Pack(aa.c[k]) + third * (s.inverse_change.c[k] - Pack(k < 3 ? 1.0 : 0.0)));
    }
    return isotropic * first_invariant_stress(s) + aligned;
  }

 private:
  Constant stiffness(int family) const { return family == 0 ? k1 : k1_second; }
  Constant exponent(int family) const { return family == 0 ? k2 : k2_second; }
  template <class T>
  T strain_of_family(const T& spread, const T& stretch) const {
    return Pack(kappa) * spread + Pack(1.0 - 3.0 * kappa) * stretch;
  }
};
using HolzapfelGasserOgden = HolzapfelGasserOgdenOf<double>;

}  // namespace fsi
