#pragma once

#include <array>
#include <optional>
#include <vector>

#include "materials/elastic_constants.hpp"
#include "materials/strain.hpp"

namespace fsi {

/// Psi = c10/2 (J_1 - 3), J_1 = I_1 I_3^(-1/3): docs/theory.md, section 5.2. c10 is the shear modulus.
template <class Constant>
struct NeoHookeanOf {
  using FibreData = NoFibres;
  Constant c10 = 0;      ///< kPa, initial shear modulus
  Constant young = 0;    ///< E, kPa; 0: c10 is given. Else c10 = E/(2 (1 + nu)), own bulk modulus E/(3 (1 - 2 nu))
  Constant poisson = 0;  ///< nu, with E

  template <class Other>
  using with = NeoHookeanOf<Other>;
  static constexpr bool has_own_loops = true;
  static constexpr auto constants() { return std::array{&NeoHookeanOf::c10}; }

  static constexpr const char* name = "neo-hookean";
  static std::vector<ParameterOf<NeoHookeanOf>> parameters() {
    return {{&NeoHookeanOf::c10, "c10", "isotropic stiffness", quantity::stiffness(), positive, false},
            ElasticConstants::young_of<NeoHookeanOf>(),
            ElasticConstants::poisson_of<NeoHookeanOf>()};
  }
  static ParameterSets parameter_sets() { return {{"c10"}, {"young", "poisson"}}; }

  /// Derives c10 from E and nu where these are given.
  void settle() {
    if (young > 0) c10 = ElasticConstants{young, poisson}.shear_modulus();
  }

  Constant shear_modulus() const { return c10; }
  std::optional<double> own_bulk_modulus() const {
    if (young > 0) return ElasticConstants{young, poisson}.compression_modulus();
    return std::nullopt;
  }
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
using NeoHookean = NeoHookeanOf<double>;

}  // namespace fsi
