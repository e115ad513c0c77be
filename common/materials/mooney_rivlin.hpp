#pragma once

#include <array>
#include <optional>
#include <vector>

#include "materials/parameter.hpp"
#include "materials/strain.hpp"

namespace fsi {

/// Psi = c10/2 (J_1 - 3) + c01/2 (J_2 - 3), J_1 = I_1 I_3^(-1/3), J_2 = I_2 I_3^(-2/3):
/// docs/theory.md, section 5.3.
template <class Constant>
struct MooneyRivlinOf {
  using FibreData = NoFibres;
  Constant c10 = 0, c01 = 0;  ///< kPa; their sum is the initial shear modulus

  template <class Other>
  using with = MooneyRivlinOf<Other>;
  static constexpr bool has_own_loops = true;
  static constexpr auto constants() { return std::array{&MooneyRivlinOf::c10, &MooneyRivlinOf::c01}; }

  static constexpr const char* name = "mooney-rivlin";
  static std::vector<ParameterOf<MooneyRivlinOf>> parameters() {
    return {{&MooneyRivlinOf::c10, "c10", "isotropic stiffness", quantity::stiffness(), positive},
            {&MooneyRivlinOf::c01, "c01", "second isotropic stiffness", quantity::stiffness(), not_negative}};
  }

  Constant shear_modulus() const { return c10 + c01; }
  std::optional<double> own_bulk_modulus() const { return std::nullopt; }
  double fibre_stiffness() const { return 0; }
  std::optional<double> inflation_modulus() const { return c10 + c01; }

  template <class T>
  T energy(const Strain<T>& s, const NoFibres&) const {
    return Pack(0.5 * c10) * first_invariant_change(s) + Pack(0.5 * c01) * second_invariant_change(s);
  }

  /// S' = c10 I_3^(-1/3) (I - I_1/3 C^-1) + c01 I_3^(-2/3) (I_1 I - C - 2/3 I_2 C^-1),
  /// the second bracket with A = C - I as 2/3 I_2 (I - C^-1) - (tr A + 2 tr cof A)/3 I - A, I_2 = 3 + 2 tr A + tr cof A
  template <class T>
  Sym3<T> stress(const Strain<T>& s, const NoFibres&) const {
    const T half = 0.5 * (s.trace_change * s.trace_change - contract(s.change, s.change));  // tr cof A
    const T i2 = 2.0 * s.trace_change + half + 3.0;
    Sym3<T> second = (i2 * Pack(2.0 / 3.0)) * s.inverse_change - s.change;
    const T volumetric = (s.trace_change + 2.0 * half) * Pack(1.0 / 3.0);
    for (int k = 0; k < 3; ++k) second.c[k] -= volumetric;
    return Pack(c10) * first_invariant_stress(s) + (Pack(c01) * s.isochoric * s.isochoric) * second;
  }
};
using MooneyRivlin = MooneyRivlinOf<double>;

}  // namespace fsi
