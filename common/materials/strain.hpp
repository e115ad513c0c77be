#pragma once

#include "math/kinematics.hpp"

namespace fsi {

/// The strain measures that materials are written in.
template <class T>
struct Strain {
  Sym3<T> c;          ///< right Cauchy-Green tensor C = F^T F
  Sym3<T> c_inverse;  ///< C^-1
  T i1;               ///< tr C
  T isochoric;        ///< I_3^(-1/3) = J^(-2/3)
};

template <class T>
inline Strain<T> strain_of(const Deformation<T>& f) {
  Strain<T> s;
  s.c = gram(f.gradient);
  const T i3 = f.volume_ratio * f.volume_ratio;
  s.c_inverse = (Pack(1.0) / i3) * cofactor(s.c);
  s.i1 = trace(s.c);
  s.isochoric = Pack(1.0) / cbrt(i3);
  return s;
}

/// Unit directions of the two fibre families in one pack of elements, Cartesian.
struct Fibres {
  Vec3<Pack> direction[2];
};
/// Stands where a material has none.
struct NoFibres {};

}  // namespace fsi
