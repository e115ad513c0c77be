#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "materials/parameter.hpp"
#include "materials/strain.hpp"

namespace fsi {

/// Arterial layer with two families of collagen fibres, active in extension only ([Holzapfel2000]; docs/theory.md,
/// section 5.4):
///   Psi = c10/2 (J_1 - 3) + s k1/(2 k2) sum over J_i > 1 of (exp(k2 (J_i - 1)^2) - 1),  J_i = I_3^(-1/3) a_i . C a_i.
/// The paper misprints energy and stress (docs/theory.md, section 12, item 3). The tangent jumps at J_i = 1.
/// With dispersed fibres element loops take it as DispersedArtery.
template <class Constant>
struct ArteryOf {
  using FibreData = Fibres;
  Constant c10 = 0;          ///< kPa, initial shear modulus without fibres
  Constant k1 = 0;           ///< kPa; at small strains a family has the modulus 4 s k1 along its fibres
  Constant k2 = 0;           ///< -
  Constant fibre_scale = 1;  ///< s, factor of the fibres' energy and stress; 0.5: the stress that the paper prints
  Constant alpha = 0;        ///< degrees between fibres and circumference; enters by the fibres' directions alone
  Constant kappa = 0;        ///< dispersion: 0 all fibres of a family parallel, 1/3 evenly in all directions

  template <class Other>
  using with = ArteryOf<Other>;
  static constexpr bool has_own_loops = true;
  static constexpr auto constants() {
    return std::array{&ArteryOf::c10, &ArteryOf::k1, &ArteryOf::k2, &ArteryOf::fibre_scale, &ArteryOf::kappa};
  }

  static constexpr const char* name = "artery";
  static std::vector<ParameterOf<ArteryOf>> parameters() {
    return {
        {&ArteryOf::c10, "c10", "isotropic stiffness", quantity::stiffness(), positive},
        {&ArteryOf::k1, "k1", "fibre stiffness", quantity::stiffness(), not_negative},
        {&ArteryOf::k2, "k2", "fibre exponent", quantity::number(), positive},
        {&ArteryOf::alpha, "alpha", "angle between fibres and circumference", quantity::angle(), {0, 90, true, true}},
        {&ArteryOf::fibre_scale, "fibre_scale", "factor on the fibre energy", quantity::number(), positive, false},
        {&ArteryOf::kappa,
         "kappa",
         "dispersion of the fibres about their directions, at most 1/3",
         quantity::number(),
         {0, 1.0 / 3, true, true},
         false}};
  }

  Constant shear_modulus() const { return c10; }
  double fibre_angle() const { return alpha * (std::acos(-1.0) / 180); }
  std::optional<double> own_bulk_modulus() const { return std::nullopt; }
  /// Two families of stretched fibres, energy s k1/2 E_i^2 each with E_i = (1 - 3 kappa) 2 eps cos^2(alpha) nearly.
  double fibre_stiffness() const {
    const double aligned = 1 - 3 * kappa;
    return 8 * fibre_scale * k1 * std::pow(std::cos(fibre_angle()), 4) * (aligned * aligned);
  }
  std::optional<double> inflation_modulus() const {
    return k1 * fibre_scale > 0 ? std::nullopt : std::optional<double>(c10);
  }

  /// With phi(x) = (exp(x) - 1) / x, phi(0) = 1, accurate for every k2 > 0:
  ///   Psi = c10/2 (J_1 - 3) + s k1/2 sum over J_i > 1 of (J_i - 1)^2 phi(k2 (J_i - 1)^2)
  template <class T>
  T energy(const Strain<T>& s, const Fibres& fibres) const {
    T psi = Pack(0.5 * c10) * first_invariant_change(s);
    for (const auto& a : fibres.direction) {
      const T stretch = extension(s, a), square = stretch * stretch;
      psi += select(stretch > 0.0, Pack(0.5 * fibre_scale * k1) * square * phi(Pack(k2) * square), T(0.0));
    }
    return psi;
  }

  /// S' = c10 I_3^(-1/3) (I - I_1/3 C^-1)
  ///    + 2 s k1 sum over J_i > 1 of exp(k2 (J_i - 1)^2) (J_i - 1) I_3^(-1/3) (a_i a_i^T - (a_i . C a_i)/3 C^-1)
  template <class T>
  Sym3<T> stress(const Strain<T>& s, const Fibres& fibres) const {
    Sym3<T> total = Pack(c10) * first_invariant_stress(s);
    for (const auto& a : fibres.direction) {
      const T stretch = extension(s, a);
      const auto active = stretch > 0.0;
      if (!any(active)) continue;
      const T tension =
          select(active, Pack(2 * fibre_scale * k1) * exp(Pack(k2) * stretch * stretch) * stretch, T(0.0));
      const T third = (stretch + 1.0) * Pack(1.0 / 3.0);  // J_i / 3
      const Sym3<Pack> aa = dyad(a);
      for (int k = 0; k < 6; ++k)
        total.c[k] +=
            tension * (s.isochoric * Pack(aa.c[k]) + third * (s.inverse_change.c[k] - Pack(k < 3 ? 1.0 : 0.0)));
    }
    return total;
  }
};
using Artery = ArteryOf<double>;

}  // namespace fsi
