#pragma once

#include <type_traits>

#include "math/pack.hpp"

namespace fsi {

/// A pack with N directional derivatives: forward-mode differentiation by the chain rule, exact to rounding.
/// Weak forms and materials are written once over their scalar type; instantiated with Pack they give the residual,
/// with Dual<N> the residual and its derivative in N seeded directions.
template <int N>
struct Dual {
  Pack value;
  Pack slope[N];

  Dual() = default;
  Dual(Pack x) : value(x) {  // NOLINT: a constant
    for (int i = 0; i < N; ++i) slope[i] = Pack(0.0);
  }
  Dual(double x) : Dual(Pack(x)) {}  // NOLINT: a constant

  Dual& operator+=(const Dual& b) {
    value += b.value;
    for (int i = 0; i < N; ++i) slope[i] += b.slope[i];
    return *this;
  }
  Dual& operator+=(Pack b) {
    value += b;
    return *this;
  }
  Dual& operator-=(const Dual& b) {
    value -= b.value;
    for (int i = 0; i < N; ++i) slope[i] -= b.slope[i];
    return *this;
  }
  Dual& operator-=(Pack b) {
    value -= b;
    return *this;
  }
};

template <class T>
struct IsDual : std::false_type {};
template <int N>
struct IsDual<Dual<N>> : std::true_type {};

/// The value without derivatives.
inline Pack value_of(Pack x) {
  return x;
}
template <int N>
inline Pack value_of(const Dual<N>& x) {
  return x.value;
}

namespace detail {
/// f(x) with derivative dfdx.
template <int N>
inline Dual<N> chained(Pack f, Pack dfdx, const Dual<N>& x) {
  Dual<N> y;
  y.value = f;
  for (int i = 0; i < N; ++i) y.slope[i] = dfdx * x.slope[i];
  return y;
}
}  // namespace detail

template <int N>
inline Dual<N> operator+(const Dual<N>& a, const Dual<N>& b) {
  Dual<N> c;
  c.value = a.value + b.value;
  for (int i = 0; i < N; ++i) c.slope[i] = a.slope[i] + b.slope[i];
  return c;
}
template <int N>
inline Dual<N> operator-(const Dual<N>& a, const Dual<N>& b) {
  Dual<N> c;
  c.value = a.value - b.value;
  for (int i = 0; i < N; ++i) c.slope[i] = a.slope[i] - b.slope[i];
  return c;
}
template <int N>
inline Dual<N> operator*(const Dual<N>& a, const Dual<N>& b) {
  Dual<N> c;
  c.value = a.value * b.value;
  for (int i = 0; i < N; ++i) c.slope[i] = a.value * b.slope[i] + b.value * a.slope[i];
  return c;
}
template <int N>
inline Dual<N> operator/(const Dual<N>& a, const Dual<N>& b) {
  Dual<N> c;
  const Pack inverse = Pack(1.0) / b.value;
  c.value = a.value * inverse;
  for (int i = 0; i < N; ++i) c.slope[i] = (a.slope[i] - c.value * b.slope[i]) * inverse;
  return c;
}
template <int N>
inline Dual<N> operator-(const Dual<N>& a) {
  return detail::chained(-a.value, Pack(-1.0), a);
}

// Mixed with constants.
template <int N>
inline Dual<N> operator+(const Dual<N>& a, Pack b) {
  Dual<N> c = a;
  c.value += b;
  return c;
}
template <int N>
inline Dual<N> operator+(Pack a, const Dual<N>& b) {
  return b + a;
}
template <int N>
inline Dual<N> operator-(const Dual<N>& a, Pack b) {
  Dual<N> c = a;
  c.value -= b;
  return c;
}
template <int N>
inline Dual<N> operator-(Pack a, const Dual<N>& b) {
  return detail::chained(a - b.value, Pack(-1.0), b);
}
template <int N>
inline Dual<N> operator*(const Dual<N>& a, Pack b) {
  return detail::chained(a.value * b, b, a);
}
template <int N>
inline Dual<N> operator*(Pack a, const Dual<N>& b) {
  return b * a;
}
template <int N>
inline Dual<N> operator/(const Dual<N>& a, Pack b) {
  return a * (Pack(1.0) / b);
}
template <int N>
inline Dual<N> operator/(Pack a, const Dual<N>& b) {
  const Pack quotient = a / b.value;
  return detail::chained(quotient, -quotient / b.value, b);
}
template <int N>
inline Dual<N> operator+(const Dual<N>& a, double b) {
  return a + Pack(b);
}
template <int N>
inline Dual<N> operator+(double a, const Dual<N>& b) {
  return b + Pack(a);
}
template <int N>
inline Dual<N> operator-(const Dual<N>& a, double b) {
  return a - Pack(b);
}
template <int N>
inline Dual<N> operator-(double a, const Dual<N>& b) {
  return Pack(a) - b;
}
template <int N>
inline Dual<N> operator*(const Dual<N>& a, double b) {
  return a * Pack(b);
}
template <int N>
inline Dual<N> operator*(double a, const Dual<N>& b) {
  return b * Pack(a);
}
template <int N>
inline Dual<N> operator/(const Dual<N>& a, double b) {
  return a * Pack(1.0 / b);
}
template <int N>
inline Dual<N> operator/(double a, const Dual<N>& b) {
  return Pack(a) / b;
}

template <int N>
inline Pack::Mask operator>(const Dual<N>& a, double b) {
  return a.value > Pack(b);
}
template <int N>
inline Dual<N> select(Pack::Mask mask, const Dual<N>& yes, const Dual<N>& no) {
  Dual<N> c;
  c.value = select(mask, yes.value, no.value);
  for (int i = 0; i < N; ++i) c.slope[i] = select(mask, yes.slope[i], no.slope[i]);
  return c;
}

template <int N>
inline Dual<N> sqrt(const Dual<N>& x) {
  const Pack root = sqrt(x.value);
  return detail::chained(root, Pack(0.5) / root, x);
}
template <int N>
inline Dual<N> exp(const Dual<N>& x) {
  const Pack e = exp(x.value);
  return detail::chained(e, e, x);
}
template <int N>
inline Dual<N> phi(const Dual<N>& x) {
  return detail::chained(phi(x.value), phi_slope(x.value), x);
}
template <int N>
inline Dual<N> cbrt(const Dual<N>& x) {
  const Pack root = cbrt(x.value);
  return detail::chained(root, root / (3.0 * x.value), x);
}

}  // namespace fsi
