#pragma once

// What the laws of a fluid's viscosity share.

#include <string>

#include "materials/parameter.hpp"

namespace fsi {

/// What is wrong with parameters together, each being within its bounds; `parameter` is the one to blame.
struct ParameterMismatch {
  std::string parameter, problem, remedy;
};

/// The mismatch of a parameter that is more than another one, `limit`, which has this value.
ParameterMismatch above_limit(const std::string& parameter, const std::string& limit, double value);

/// Bounds of the exponent: below 1 the fluid thins with the shear rate, above it thickens.
inline constexpr Bounds shear_exponent{0, 2, false, true};

namespace quantity {
/// K of K g^(n - 1)
inline const Quantity& consistency() {
  static const Quantity q{"kPa ms^n", {}};
  return q;
}
}  // namespace quantity

}  // namespace fsi
