#pragma once

#include "math/kinematics.hpp"

namespace fsi {

/// The strain measures that materials are written in: differences from the undeformed state, without the ones and
/// threes of that state. So stresses are accurate to rounding however small the strain (docs/theory.md, section 5.1).
template <class T>
struct Strain {
  Sym3<T> change;          ///< C - I, C = F^T F the right Cauchy-Green tensor
  Sym3<T> inverse_change;  ///< I - C^-1 = C^-1 (C - I)
  T trace_change;          ///< I_1 - 3 = tr(C - I)
  T isochoric;             ///< I_3^(-1/3) = J^(-2/3)
  T isochoric_change;      ///< I_3^(-1/3) - 1
};

/// The strain of C - I = A by
///   cof C = (1 + tr A) I - A + cof A,   r - 1 = (I_3 - 1) / (r^2 + r + 1),   r = I_3^(1/3).
/// \param i3_change  I_3 - 1
template <class T>
inline Strain<T> strain_from(const Sym3<T>& change, const T& i3_change) {
  Strain<T> s;
  s.change = change;
  s.trace_change = trace(change);
  const T i3 = i3_change + 1.0;
  const T inverse = Pack(1.0) / i3;
  const T rest = (i3_change - s.trace_change) * inverse;
  const Sym3<T> cof = cofactor(change);
  for (int k = 0; k < 6; ++k) {
    s.inverse_change.c[k] = (change.c[k] - cof.c[k]) * inverse;
    if (k < 3) s.inverse_change.c[k] += rest;
  }
  const T root = cbrt(i3);
  s.isochoric = Pack(1.0) / root;
  s.isochoric_change = -(i3_change / (root * root + root + 1.0)) * s.isochoric;
  return s;
}

/// C - I = H + H^T + H^T H. \param h  H = grad d
template <class T>
inline Sym3<T> strain_change(const Mat3<T>& h) {
  Sym3<T> change = gram(h);
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) change(i, j) += h(i, j) + h(j, i);
  return change;
}

/// The strain of a displacement.
/// \param h  grad d
/// \param f  deformation(h)
template <class T>
inline Strain<T> strain_of(const Mat3<T>& h, const Deformation<T>& f) {
  Sym3<T> change = gram(h);
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) change(i, j) += h(i, j) + h(j, i);
  return strain_from(change, f.volume_change * (f.volume_ratio + 1.0));
}
template <class T>
inline Strain<T> strain_of(const Mat3<T>& h) {
  return strain_of(h, deformation(h));
}

/// I - C^-1 alone, of A = C - I, as in strain_from().
template <class T>
inline Sym3<T> inverse_strain_change(const Sym3<T>& change, const T& i3_change) {
  const T inverse = Pack(1.0) / (i3_change + 1.0);
  const T rest = (i3_change - trace(change)) * inverse;
  const Sym3<T> cof = cofactor(change);
  Sym3<T> inverse_change;
  for (int k = 0; k < 6; ++k) {
    inverse_change.c[k] = (change.c[k] - cof.c[k]) * inverse;
    if (k < 3) inverse_change.c[k] += rest;
  }
  return inverse_change;
}

/// S' of Psi = (J_1 - 3)/2, J_1 = I_1 I_3^(-1/3): I_3^(-1/3) (I - I_1/3 C^-1).
template <class T>
inline Sym3<T> first_invariant_stress(const Strain<T>& s) {
  const T third = s.trace_change * Pack(1.0 / 3.0);
  Sym3<T> stress = (third + 1.0) * s.inverse_change;
  for (int k = 0; k < 3; ++k) stress.c[k] -= third;
  return s.isochoric * stress;
}

namespace detail {
/// What the invariants of C need beyond its trace: tr cof(C - I), det(C - I), r = I_3^(1/3) and r - 1.
template <class T>
struct HigherInvariants {
  T second, third, root, root_change;
};
template <class T>
inline HigherInvariants<T> higher_invariants(const Strain<T>& s) {
  const Sym3<T> cof = cofactor(s.change);
  HigherInvariants<T> i;
  i.second = trace(cof);
  i.third = s.change(0, 0) * cof(0, 0) + s.change(0, 1) * cof(0, 1) + s.change(0, 2) * cof(0, 2);
  i.root = Pack(1.0) / s.isochoric;
  i.root_change = -s.isochoric_change * i.root;
  return i;
}
}  // namespace detail

/// J_1 - 3, J_1 = I_1 I_3^(-1/3), as a sum of terms of second order in C - I: with t = tr(C - I),
///   J_1 - 3 = (t (r - 1) (r + 2) - 3 (tr cof(C - I) + det(C - I))) / (r (r^2 + r + 1)).
template <class T>
inline T first_invariant_change(const Strain<T>& s) {
  const auto i = detail::higher_invariants(s);
  const T& r = i.root;
  return (s.trace_change * i.root_change * (r + 2.0) - 3.0 * (i.second + i.third)) / (r * (r * r + r + 1.0));
}

/// J_2 - 3, J_2 = I_2 I_3^(-2/3), likewise:
///   J_2 - 3 = (t (2 r + 1) (r - 1) + tr cof(C - I) (r^2 - 2 r - 2) - 3 det(C - I) (r + 1)) / (r^2 (r^2 + r + 1)).
template <class T>
inline T second_invariant_change(const Strain<T>& s) {
  const auto i = detail::higher_invariants(s);
  const T& r = i.root;
  return (s.trace_change * (2.0 * r + 1.0) * i.root_change + i.second * (r * r - 2.0 * r - 2.0) -
          3.0 * i.third * (r + 1.0)) /
         (r * r * (r * r + r + 1.0));
}

/// J_i - 1 for a unit vector a_i: I_3^(-1/3) a_i . (C - I) a_i + I_3^(-1/3) - 1.
template <class T>
inline T extension(const Strain<T>& s, const Vec3<Pack>& a) {
  return s.isochoric * dot(a, s.change * a) + s.isochoric_change;
}

/// Unit directions of the two fibre families in one pack of elements, Cartesian.
struct Fibres {
  Vec3<Pack> direction[2];
};
/// Stands for the fibres of a material without.
struct NoFibres {};

}  // namespace fsi
