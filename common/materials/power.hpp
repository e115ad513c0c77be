#pragma once

#include <cmath>

#include "math/dual.hpp"

namespace fsi {

/// x^e of a positive x.
inline Pack power(const Pack& x, double e) {
  return each(x, [e](double v) { return std::pow(v, e); });
}
template <int N>
inline Dual<N> power(const Dual<N>& x, double e) {
  const Pack p = power(x.value, e);
  return detail::chained(p, Pack(e) * p / x.value, x);
}

}  // namespace fsi
