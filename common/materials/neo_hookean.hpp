#pragma once

#include <optional>
#include <vector>

#include "materials/parameter.hpp"
#include "materials/strain.hpp"

namespace fsi {

/// Psi = c10/2 (J_1 - 3), J_1 = I_1 I_3^(-1/3): docs/theory.md, section 5.2. c10 is the shear modulus.
struct NeoHookean {
  using FibreData = NoFibres;
  double c10 = 0;  ///< kPa, initial shear modulus

  static constexpr const char* name = "neo-hookean";
  static std::vector<ParameterOf<NeoHookean>> parameters() {
    return {{&NeoHookean::c10, "c10", "isotropic stiffness", quantity::stiffness(), positive}};
  }

  double shear_modulus() const { return c10; }
  double fibre_stiffness() const { return 0; }
  std::optional<double> inflation_modulus() const { return c10; }

  template <class T>
  T energy(const Strain<T>& s, const NoFibres&) const {
    return Pack(0.5 * c10) * first_invariant_change(s);
  }

  /// S' = 2 dPsi/dC = c10 I_3^(-1/3) (I - I_1/3 C^-1)
  template <class T>
  Sym3<T> stress(const Strain<T>& s, const NoFibres&) const {
    return Pack(c10) * first_invariant_stress(s);
  }
};

}  // namespace fsi
