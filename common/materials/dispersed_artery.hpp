#pragma once

#include <string>
#include <variant>

#include "materials/artery.hpp"
#include "materials/forms.hpp"

namespace fsi {

/// The artery's law with fibres that are dispersed about their families' directions ([Gasser2006]; docs/theory.md,
/// section 5.4). With E_i = kappa (J_1 - 3) + (1 - 3 kappa) (J_i - 1)
///   Psi = c10/2 (J_1 - 3) + s k1/(2 k2) sum over E_i > 0 of (exp(k2 E_i^2) - 1).
/// A type of its own, so that loops over parallel fibres do not pay for the dispersion.
template <class Constant>
struct DispersedArteryOf : ArteryOf<Constant> {
  template <class Other>
  using with = DispersedArteryOf<Other>;

  template <class T>
  T energy(const Strain<T>& s, const Fibres& fibres) const {
    const T spread = first_invariant_change(s);
    T psi = Pack(0.5 * this->c10) * spread;
    for (const auto& a : fibres.direction) {
      const T e = strain_of_family(spread, extension(s, a)), square = e * e;
      psi += select(e > 0.0, Pack(0.5 * this->fibre_scale * this->k1) * square * phi(Pack(this->k2) * square), T(0.0));
    }
    return psi;
  }

  /// S' = (c10 + 2 kappa sum of t_i) dJ_1/dC + 2 (1 - 3 kappa) sum of t_i dJ_i/dC, t_i = s k1 exp(k2 E_i^2) E_i,
  /// sums over E_i > 0
  template <class T>
  Sym3<T> stress(const Strain<T>& s, const Fibres& fibres) const {
    const T spread = first_invariant_change(s);
    T isotropic(this->c10);
    Sym3<T> aligned{};
    for (const auto& a : fibres.direction) {
      const T stretch = extension(s, a), e = strain_of_family(spread, stretch);
      const auto active = e > 0.0;
      if (!any(active)) continue;
      const T tension =
          select(active, Pack(2 * this->fibre_scale * this->k1) * exp(Pack(this->k2) * e * e) * e, T(0.0));
      isotropic += Pack(this->kappa) * tension;
      const T along = Pack(1 - 3 * this->kappa) * tension, third = (stretch + 1.0) * Pack(1.0 / 3.0);  // J_i / 3
      const Sym3<Pack> aa = dyad(a);
      for (int k = 0; k < 6; ++k)
        aligned.c[k] +=
            along * (s.isochoric * Pack(aa.c[k]) + third * (s.inverse_change.c[k] - Pack(k < 3 ? 1.0 : 0.0)));
    }
    return isotropic * first_invariant_stress(s) + aligned;
  }

 private:
  /// E_i of J_1 - 3 and J_i - 1.
  template <class T>
  T strain_of_family(const T& spread, const T& stretch) const {
    return Pack(this->kappa) * spread + Pack(1 - 3 * this->kappa) * stretch;
  }
};
using DispersedArtery = DispersedArteryOf<double>;

/// The artery's law has two forms; the second holds for any dispersion.
template <>
struct FormsOf<Artery> {
  using type = Laws<Artery, DispersedArtery>;
  static bool decides(const std::string& parameter) { return parameter == "kappa"; }
  static std::variant<Artery, DispersedArtery> of(const Artery& law, bool varies) {
    if (law.kappa > 0 || varies) return DispersedArtery{law};
    return law;
  }
};

}  // namespace fsi
