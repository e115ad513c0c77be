#pragma once

#include <array>
#include <optional>
#include <vector>

#include "materials/parameter.hpp"
#include "materials/strain.hpp"

namespace fsi {

/// Psi = c10/2 (J_1 - 3) + c20 (J_1 - 3)^2 + c30 (J_1 - 3)^3, J_1 = I_1 I_3^(-1/3) ([Yeoh1993]; docs/theory.md, section
/// 5.3). c10 is the shear modulus, as in all laws here: twice the C_10 of other programs. None of the constants is
/// negative, so that the energy is convex in J_1.
template <class Constant>
struct YeohOf {
  using FibreData = NoFibres;
  Constant c10 = 0;  ///< kPa, initial shear modulus
  Constant c20 = 0;  ///< kPa
  Constant c30 = 0;  ///< kPa

  template <class Other>
  using with = YeohOf<Other>;
  static constexpr bool has_own_loops = false;
  static constexpr auto constants() { return std::array{&YeohOf::c10, &YeohOf::c20, &YeohOf::c30}; }

  static constexpr const char* name = "yeoh";
  static std::vector<ParameterOf<YeohOf>> parameters() {
    return {
        {&YeohOf::c10, "c10", "isotropic stiffness, the shear modulus", quantity::stiffness(), positive},
        {&YeohOf::c20, "c20", "stiffness of the second order in J_1 - 3", quantity::stiffness(), not_negative, false},
        {&YeohOf::c30, "c30", "stiffness of the third order in J_1 - 3", quantity::stiffness(), not_negative, false}};
  }

  Constant shear_modulus() const { return c10; }
  std::optional<double> own_bulk_modulus() const { return std::nullopt; }
  double fibre_stiffness() const { return 0; }
  /// J_1 grows without end: with a term of higher order so does the pressure.
  std::optional<double> inflation_modulus() const {
    return c20 > 0 || c30 > 0 ? std::nullopt : std::optional<double>(c10);
  }

  template <class T>
  T energy(const Strain<T>& s, const NoFibres&) const {
    const T x = first_invariant_change(s);
    return x * (Pack(0.5 * c10) + x * (Pack(c20) + Pack(c30) * x));
  }

  /// S' = (c10 + 4 c20 x + 6 c30 x^2) I_3^(-1/3) (I - I_1/3 C^-1), x = J_1 - 3
  template <class T>
  Sym3<T> stress(const Strain<T>& s, const NoFibres&) const {
    const T x = first_invariant_change(s);
    return (x * (Pack(4.0 * c20) + Pack(6.0 * c30) * x) + Pack(c10)) * first_invariant_stress(s);
  }
};
using Yeoh = YeohOf<double>;

}  // namespace fsi
