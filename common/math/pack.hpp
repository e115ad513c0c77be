#pragma once

#include <cmath>
#include <cstdint>

namespace fsi {

/// Doubles that one vector instruction handles. Element kernels use a pack as their scalar type, one element per lane.
#if defined(FSI_PACK_WIDTH)  // only to measure other widths: docs/performance.md
inline constexpr int pack_width = FSI_PACK_WIDTH;
#elif defined(__AVX512F__)
inline constexpr int pack_width = 8;
#elif defined(__AVX__)
inline constexpr int pack_width = 4;
#else
inline constexpr int pack_width = 2;
#endif

/// A short vector of doubles with arithmetic lane by lane.
struct Pack {
  using Lanes = double __attribute__((vector_size(8 * pack_width)));
  using Mask = std::int64_t __attribute__((vector_size(8 * pack_width)));  ///< all bits set where true

  Lanes lanes;

  Pack() = default;
  Pack(double x) : lanes(Lanes{} + x) {}  // NOLINT: a number stands for a pack of equal lanes
  explicit Pack(Lanes x) : lanes(x) {}

  double operator[](int lane) const { return lanes[lane]; }
  void set(int lane, double x) { lanes[lane] = x; }
  static Pack load(const double* from) {
    Pack x;
    __builtin_memcpy(&x.lanes, from, sizeof(Lanes));
    return x;
  }

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
inline Pack exp(Pack x) {
  return each(x, [](double v) { return std::exp(v); });
}
/// phi(x) = (exp(x) - 1) / x, phi(0) = 1, to rounding for every x.
inline Pack phi(Pack x) {
  return each(x, [](double v) { return v == 0 ? 1.0 : std::expm1(v) / v; });
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
inline Pack cbrt(Pack x) {
  return each(x, [](double v) { return std::cbrt(v); });
}

}  // namespace fsi
