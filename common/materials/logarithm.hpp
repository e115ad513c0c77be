#pragma once

#include <cmath>

#include "math/dual.hpp"

namespace fsi {

/// ln(1 + x), to rounding for small x too.
inline Pack log1p(Pack x) {
  return each(x, [](double v) { return std::log1p(v); });
}
template <int N>
inline Dual<N> log1p(const Dual<N>& x) {
  return detail::chained(log1p(x.value), Pack(1.0) / (x.value + Pack(1.0)), x);
}

/// x - ln(1 + x), to rounding for small x too: with s = x / (2 + x), ln(1 + x) = 2 (s + s^3/3 + s^5/5 + ...), it is
/// x s - 2 (s^3/3 + s^5/5 + ...).
inline Pack minus_log1p(Pack x) {
  return each(x, [](double v) {
    if (!(std::abs(v) < 0.3)) return v - std::log1p(v);
    const double s = v / (2 + v), square = s * s;
    double sum = 0;  // to s^19: the rest is at most 3e-16 of the result, at v = -0.3
    for (int k = 19; k >= 3; k -= 2) sum = sum * square + 1.0 / k;
    return v * s - 2 * s * square * sum;
  });
}
template <int N>
inline Dual<N> minus_log1p(const Dual<N>& x) {
  return detail::chained(minus_log1p(x.value), x.value / (x.value + Pack(1.0)), x);
}

}  // namespace fsi
