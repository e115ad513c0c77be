#pragma once

#include <cmath>
#include <cstdint>

#include "host/instruction_set.hpp"

namespace fsi {

/// Doubles that one vector instruction handles. Element kernels use a pack as their scalar type, one element per lane.
#if defined(FSI_PACK_WIDTH)  // only to measure other widths: docs/guide/solvers.md#speed
inline constexpr int pack_width = FSI_PACK_WIDTH;
#else
inline constexpr int pack_width = vector_doubles;
#endif

/// A short vector of doubles with arithmetic lane by lane.
struct Pack {
  using Lanes = double __attribute__((vector_size(8 * pack_width)));
  using Mask = std::int64_t __attribute__((vector_size(8 * pack_width)));  ///< all bits set where true

  Lanes lanes;

  Pack() = default;
  // A number stands for a pack of equal lanes. Minus zero, not plus zero: x - 0 is x also for -0, so that the compiler
  // drops the operation.
  Pack(double x) : lanes(x - Lanes{}) {}  // NOLINT
  explicit Pack(Lanes x) : lanes(x) {}

  double operator[](int lane) const { return lanes[lane]; }
  void set(int lane, double x) { lanes[lane] = x; }
  static Pack load(const double* from) {
    Pack x;
    __builtin_memcpy(&x.lanes, from, sizeof(Lanes));
    return x;
  }
  void store(double* to) const { __builtin_memcpy(to, &lanes, sizeof(Lanes)); }

  Pack& operator+=(Pack x) {
    lanes += x.lanes;
    return *this;
  }
  Pack& operator-=(Pack x) {
    lanes -= x.lanes;
    return *this;
  }
  Pack& operator*=(Pack x) {
    lanes *= x.lanes;
    return *this;
  }
};

inline Pack operator+(Pack a, Pack b) {
  return Pack(a.lanes + b.lanes);
}
inline Pack operator-(Pack a, Pack b) {
  return Pack(a.lanes - b.lanes);
}
inline Pack operator*(Pack a, Pack b) {
  return Pack(a.lanes * b.lanes);
}
inline Pack operator/(Pack a, Pack b) {
  return Pack(a.lanes / b.lanes);
}
inline Pack operator-(Pack a) {
  return Pack(-a.lanes);
}
inline Pack::Mask operator>(Pack a, Pack b) {
  return a.lanes > b.lanes;
}
inline Pack select(Pack::Mask mask, Pack yes, Pack no) {
  return Pack(mask ? yes.lanes : no.lanes);
}

inline bool any(Pack::Mask mask) {
  std::int64_t found = 0;
  for (int i = 0; i < pack_width; ++i) found |= mask[i];
  return found != 0;
}

/// Applies a scalar function lane by lane.
template <class Function>
inline Pack each(Pack x, Function f) {
  Pack y;
  for (int i = 0; i < pack_width; ++i) y.lanes[i] = f(x.lanes[i]);
  return y;
}

inline Pack sqrt(Pack x) {
  return each(x, [](double v) { return __builtin_sqrt(v); });
}
namespace detail {

/// exp(x) = scale (1 + rest): scale = 2^k, rest = exp(r) - 1, r = x - k ln 2, |r| <= (ln 2) / 2, as [Cody1980] reduces
/// x. By Taylor's series up to r^13/13!, whose remainder is 4e-18. For |x| < 700. Errors of exp() and phi(): 0.8 and
/// 1.6 units in the last place (tests/unit/math/test_pack.cpp).
struct SplitExponential {
  explicit SplitExponential(Pack x) {
    const Pack shift(6755399441055744.0);  // 1.5 * 2^52: a sum with it holds k in its last bits
    const Pack shifted = x * Pack(1.4426950408889634) + shift, k = shifted - shift;
    // ln 2 in two parts, the first of which is short enough for its products with k to be exact.
    const Pack r = (x - k * Pack(0x1.62e42fefa38p-1)) - k * Pack(0x1.ef35793c7673p-45);
    constexpr double inverse_factorials[] = {1.0 / 2,       1.0 / 6,        1.0 / 24,        1.0 / 120,
                                             1.0 / 720,     1.0 / 5040,     1.0 / 40320,     1.0 / 362880,
                                             1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800};
    Pack sum(inverse_factorials[11]);
    for (int i = 10; i >= 0; --i) sum = sum * r + Pack(inverse_factorials[i]);
    rest = r + r * r * sum;
    Pack::Mask bits;
    __builtin_memcpy(&bits, &shifted.lanes, sizeof(bits));
    bits = (bits + 1023) << 52;  // what is above k in them is shifted out
    __builtin_memcpy(&scale.lanes, &bits, sizeof(bits));
  }
  static bool serves(Pack x) { return !any(~((x > Pack(-700.0)) & (Pack(700.0) > x))); }

  Pack scale, rest;
};

}  // namespace detail

/// All lanes at once where every |x| < 700, else library calls lane by lane, which take five times as long.
inline Pack exp(Pack x) {
  if (!detail::SplitExponential::serves(x)) return each(x, [](double v) { return std::exp(v); });
  const detail::SplitExponential e(x);
  return e.scale + e.scale * e.rest;
}
/// phi(x) = (exp(x) - 1) / x, phi(0) = 1, to rounding for every x.
inline Pack phi(Pack x) {
  if (!detail::SplitExponential::serves(x)) return each(x, [](double v) { return v == 0 ? 1.0 : std::expm1(v) / v; });
  const detail::SplitExponential e(x);
  return select(Pack::Mask(x.lanes == Pack(0.0).lanes), Pack(1.0), (e.scale * e.rest + (e.scale - Pack(1.0))) / x);
}
/// phi'(x) = (exp(x) - phi(x)) / x = sum over k of (k + 1) x^k / (k + 2)!; the series where the quotient cancels.
inline Pack phi_slope(Pack x) {
  return each(x, [](double v) {
    if (std::abs(v) > 1) return (std::exp(v) - std::expm1(v) / v) / v;
    double sum = 0;
    for (int k = 18; k > 0; --k) sum = (sum + 1) * v * (k + 1.0) / (k * (k + 2.0));  // ratio of terms k and k - 1
    return 0.5 * (sum + 1);
  });
}
/// All lanes at once where every x is between 1e-60 and 1e60, else library calls. Without a division: r = x^(-1/3) from
/// a guess within 4 %, which a third of the exponent gives, by two steps of the series (1 - e)^(-1/3) = 1 + e/3 +
/// 2/9 e^2 + 14/81 e^3 + ..., e = 1 - x r^3. Then x r^2 and one Newton step.
inline Pack cbrt(Pack x) {
  if (any(~((x > Pack(1e-60)) & (Pack(1e60) > x)))) return each(x, [](double v) { return std::cbrt(v); });
  Pack::Mask bits;
  __builtin_memcpy(&bits, &x.lanes, sizeof(bits));
  // The upper 22 bits are the exponent and the first ten bits of the fraction; 0x55555 / 2^20 is a third. The constant,
  // four thirds of the exponent's bias and a little less, makes the guess too large and too small by as much.
  bits = (std::int64_t{0x553ef000} << 32) - (((bits >> 42) * 0x55555 >> 20) << 42);
  Pack r;
  __builtin_memcpy(&r.lanes, &bits, sizeof(bits));
  for (int step = 0; step < 2; ++step) {
    const Pack e = Pack(1.0) - x * (r * r * r);
    r += r * e * (Pack(1.0 / 3) + e * (Pack(2.0 / 9) + e * Pack(14.0 / 81)));
  }
  const Pack square = r * r, root = x * square;
  return root + (x - root * root * root) * (square * Pack(1.0 / 3));
}

}  // namespace fsi
