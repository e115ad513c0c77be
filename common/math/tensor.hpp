#pragma once

#include <utility>

#include "math/dual.hpp"

namespace fsi {

/// A vector of three components over any scalar type.
template <class T>
struct Vec3 {
  T c[3];
  T& operator[](int i) { return c[i]; }
  const T& operator[](int i) const { return c[i]; }
};

/// A full 3 x 3 tensor, m(i, j) with i the row.
template <class T>
struct Mat3 {
  T c[3][3];
  T& operator()(int i, int j) { return c[i][j]; }
  const T& operator()(int i, int j) const { return c[i][j]; }
};

/// A symmetric 3 x 3 tensor, six stored components.
template <class T>
struct Sym3 {
  T c[6];  // 00 11 22 01 12 02
  static constexpr int at(int i, int j) { return i == j ? i : (i + j == 1 ? 3 : (i + j == 3 ? 4 : 5)); }
  T& operator()(int i, int j) { return c[at(i, j)]; }
  const T& operator()(int i, int j) const { return c[at(i, j)]; }
};

template <class A, class B>
using Product = decltype(std::declval<A>() * std::declval<B>());

// --- vectors -------------------------------------------------------------------------------------------------------
template <class A, class B>
inline auto operator+(const Vec3<A>& a, const Vec3<B>& b) {
  return Vec3<decltype(a[0] + b[0])>{{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
}
template <class A, class B>
inline auto operator-(const Vec3<A>& a, const Vec3<B>& b) {
  return Vec3<decltype(a[0] - b[0])>{{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
}
template <class A, class B>
inline auto operator*(const A& s, const Vec3<B>& b) {
  return Vec3<Product<A, B>>{{s * b[0], s * b[1], s * b[2]}};
}
template <class A, class B>
inline auto dot(const Vec3<A>& a, const Vec3<B>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
inline Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

// --- full tensors --------------------------------------------------------------------------------------------------
template <class A, class B>
inline auto operator+(const Mat3<A>& a, const Mat3<B>& b) {
  Mat3<decltype(a(0, 0) + b(0, 0))> c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c(i, j) = a(i, j) + b(i, j);
  return c;
}
template <class A, class B>
inline auto operator-(const Mat3<A>& a, const Mat3<B>& b) {
  Mat3<decltype(a(0, 0) - b(0, 0))> c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c(i, j) = a(i, j) - b(i, j);
  return c;
}
template <class A, class B>
inline auto operator*(const A& s, const Mat3<B>& b) {
  Mat3<Product<A, B>> c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c(i, j) = s * b(i, j);
  return c;
}
template <class A, class B>
inline auto operator*(const Mat3<A>& a, const Mat3<B>& b) {
  Mat3<Product<A, B>> c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
  return c;
}
template <class A, class B>
inline auto operator*(const Mat3<A>& a, const Vec3<B>& b) {
  Vec3<Product<A, B>> c;
  for (int i = 0; i < 3; ++i) c[i] = a(i, 0) * b[0] + a(i, 1) * b[1] + a(i, 2) * b[2];
  return c;
}
/// a^T b without forming the transpose.
template <class A, class B>
inline auto transposed_times(const Mat3<A>& a, const Vec3<B>& b) {
  Vec3<Product<A, B>> c;
  for (int i = 0; i < 3; ++i) c[i] = a(0, i) * b[0] + a(1, i) * b[1] + a(2, i) * b[2];
  return c;
}
/// a b^T.
template <class A, class B>
inline auto times_transposed(const Mat3<A>& a, const Mat3<B>& b) {
  Mat3<Product<A, B>> c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c(i, j) = a(i, 0) * b(j, 0) + a(i, 1) * b(j, 1) + a(i, 2) * b(j, 2);
  return c;
}
template <class T>
inline T trace(const Mat3<T>& a) {
  return a(0, 0) + a(1, 1) + a(2, 2);
}
/// a : b
template <class A, class B>
inline auto contract(const Mat3<A>& a, const Mat3<B>& b) {
  Product<A, B> sum = a(0, 0) * b(0, 0);
  for (int k = 1; k < 9; ++k) sum += a(k / 3, k % 3) * b(k / 3, k % 3);
  return sum;
}

/// The cofactor tensor, cof a = det(a) a^-T.
template <class T>
inline Mat3<T> cofactor(const Mat3<T>& a) {
  Mat3<T> c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      c(i, j) = a(i1, j1) * a(i2, j2) - a(i1, j2) * a(i2, j1);
    }
  return c;
}

// --- symmetric tensors ---------------------------------------------------------------------------------------------
template <class A, class B>
inline auto operator+(const Sym3<A>& a, const Sym3<B>& b) {
  Sym3<decltype(a.c[0] + b.c[0])> c;
  for (int k = 0; k < 6; ++k) c.c[k] = a.c[k] + b.c[k];
  return c;
}
template <class A, class B>
inline auto operator-(const Sym3<A>& a, const Sym3<B>& b) {
  Sym3<decltype(a.c[0] - b.c[0])> c;
  for (int k = 0; k < 6; ++k) c.c[k] = a.c[k] - b.c[k];
  return c;
}
template <class A, class B>
inline auto operator*(const A& s, const Sym3<B>& b) {
  Sym3<Product<A, B>> c;
  for (int k = 0; k < 6; ++k) c.c[k] = s * b.c[k];
  return c;
}
template <class A, class B>
inline auto operator*(const Sym3<A>& a, const Vec3<B>& b) {
  Vec3<Product<A, B>> c;
  for (int i = 0; i < 3; ++i) c[i] = a(i, 0) * b[0] + a(i, 1) * b[1] + a(i, 2) * b[2];
  return c;
}
template <class A, class B>
inline auto operator*(const Mat3<A>& a, const Sym3<B>& b) {
  Mat3<Product<A, B>> c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
  return c;
}
template <class T>
inline T trace(const Sym3<T>& a) {
  return a.c[0] + a.c[1] + a.c[2];
}
/// a : b
template <class A, class B>
inline auto contract(const Sym3<A>& a, const Sym3<B>& b) {
  return a.c[0] * b.c[0] + a.c[1] * b.c[1] + a.c[2] * b.c[2] +
         2.0 * (a.c[3] * b.c[3] + a.c[4] * b.c[4] + a.c[5] * b.c[5]);
}
/// a^T a
template <class T>
inline Sym3<T> gram(const Mat3<T>& a) {
  Sym3<T> c;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) c(i, j) = a(0, i) * a(0, j) + a(1, i) * a(1, j) + a(2, i) * a(2, j);
  return c;
}
/// a^T s a
template <class A, class B>
inline auto congruence(const Sym3<A>& s, const Mat3<B>& a) {
  Mat3<Product<A, B>> sa;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) sa(i, j) = s(i, 0) * a(0, j) + s(i, 1) * a(1, j) + s(i, 2) * a(2, j);
  Sym3<Product<A, B>> c;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) c(i, j) = a(0, i) * sa(0, j) + a(1, i) * sa(1, j) + a(2, i) * sa(2, j);
  return c;
}
/// The cofactor tensor of a symmetric tensor, det(a) a^-1.
template <class T>
inline Sym3<T> cofactor(const Sym3<T>& a) {
  Sym3<T> c;
  c(0, 0) = a(1, 1) * a(2, 2) - a(1, 2) * a(1, 2);
  c(1, 1) = a(0, 0) * a(2, 2) - a(0, 2) * a(0, 2);
  c(2, 2) = a(0, 0) * a(1, 1) - a(0, 1) * a(0, 1);
  c(0, 1) = a(0, 2) * a(1, 2) - a(0, 1) * a(2, 2);
  c(1, 2) = a(0, 1) * a(0, 2) - a(0, 0) * a(1, 2);
  c(0, 2) = a(0, 1) * a(1, 2) - a(0, 2) * a(1, 1);
  return c;
}
/// v v^T
template <class T>
inline Sym3<T> dyad(const Vec3<T>& v) {
  Sym3<T> c;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) c(i, j) = v[i] * v[j];
  return c;
}
template <class T>
inline Sym3<T> identity() {
  Sym3<T> c;
  for (int k = 0; k < 6; ++k) c.c[k] = T(k < 3 ? 1.0 : 0.0);
  return c;
}

}  // namespace fsi
