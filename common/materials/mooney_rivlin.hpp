#pragma once

#include <optional>
#include <vector>

#include "materials/parameter.hpp"
#include "materials/strain.hpp"

namespace fsi {

/// Psi = c10/2 (J_1 - 3) + c01/2 (J_2 - 3), J_1 = I_1 I_3^(-1/3), J_2 = I_2 I_3^(-2/3):
/// docs/theory.md, section 5.3.
struct MooneyRivlin {
  using FibreData = NoFibres;
  double c10 = 0, c01 = 0;  ///< kPa; their sum is the initial shear modulus

  static constexpr const char* name = "mooney-rivlin";
  static std::vector<ParameterOf<MooneyRivlin>> parameters() {
    return {{&MooneyRivlin::c10, "c10", "isotropic stiffness", quantity::stiffness(), positive},
            {&MooneyRivlin::c01, "c01", "second isotropic stiffness", quantity::stiffness(), not_negative}};
  }

  double shear_modulus() const { return c10 + c01; }
  double fibre_stiffness() const { return 0; }
  std::optional<double> inflation_modulus() const { return c10 + c01; }

  template <class T>
  static T i2(const Strain<T>& s) {
    return Pack(0.5) * (s.i1 * s.i1 - contract(s.c, s.c));
  }

  template <class T>
  T energy(const Strain<T>& s, const NoFibres&) const {
    return Pack(0.5 * c10) * (s.i1 * s.isochoric - 3.0) + Pack(0.5 * c01) * (i2(s) * s.isochoric * s.isochoric - 3.0);
  }

  /// S' = c10 I_3^(-1/3) (I - I_1/3 C^-1) + c01 I_3^(-2/3) (I_1 I - C - 2/3 I_2 C^-1)
  template <class T>
  Sym3<T> stress(const Strain<T>& s, const NoFibres&) const {
    const Sym3<T> first = (Pack(c10) * s.isochoric) * (identity<T>() - (s.i1 * Pack(1.0 / 3.0)) * s.c_inverse);
    const Sym3<T> second = (Pack(c01) * s.isochoric * s.isochoric) *
                           (s.i1 * identity<T>() - s.c - (i2(s) * Pack(2.0 / 3.0)) * s.c_inverse);
    return first + second;
  }
};

}  // namespace fsi
