#pragma once

#include <optional>
#include <vector>

#include "materials/power.hpp"
#include "materials/shear_law.hpp"

namespace fsi {

/// mu = K g^(n - 1), no less than the lowest and no more than the highest viscosity: docs/theory.md, section 3.9
/// [Ostwald1925]. At a limit its derivative jumps to zero.
struct PowerLaw {
  double consistency = 0;                              ///< K, kPa ms^n
  double exponent = 1;                                 ///< n
  double lowest_viscosity = 0, highest_viscosity = 0;  ///< kPa ms

  static constexpr const char* name = "power-law";
  static std::vector<ParameterOf<PowerLaw>> parameters() {
    return {{&PowerLaw::consistency, "consistency", "consistency", quantity::consistency(), positive},
            {&PowerLaw::exponent, "exponent", "exponent", quantity::number(), shear_exponent},
            {&PowerLaw::lowest_viscosity, "lowest_viscosity", "lower limit", quantity::viscosity(), positive},
            {&PowerLaw::highest_viscosity, "highest_viscosity", "upper limit", quantity::viscosity(), positive}};
  }
  std::optional<ParameterMismatch> problem() const {
    if (lowest_viscosity <= highest_viscosity) return std::nullopt;
    return above_limit("lowest_viscosity", "highest_viscosity", highest_viscosity);
  }

  /// \param shear_rate  g, positive, 1/ms \return kPa ms
  template <class T>
  T viscosity(const T& shear_rate) const {
    const T unlimited = Pack(consistency) * power(shear_rate, exponent - 1);
    const T from_below = select(unlimited > lowest_viscosity, unlimited, T(lowest_viscosity));
    return select(from_below > highest_viscosity, T(highest_viscosity), from_below);
  }
};

}  // namespace fsi
