#pragma once

#include "math/tensor.hpp"

namespace fsi {

/// Deformation x = X + d: F = I + grad d, its cofactor tensor and its volume ratio.
template <class T>
struct Deformation {
  Mat3<T> gradient;           ///< F
  Mat3<T> cofactor_gradient;  ///< cof F = J F^-T
  T volume_change;            ///< J - 1, free of cancellation
  T volume_ratio;             ///< J
};

/// J - 1 from H = grad d as tr H + (sum of principal 2x2 minors) + det H (docs/theory.md, section 2.2). The
/// cancellation in det(I + H) - 1 would show at large bulk moduli.
template <class T>
inline T volume_change(const Mat3<T>& h) {
  const T m0 = h(1, 1) * h(2, 2) - h(1, 2) * h(2, 1);
  const T m1 = h(0, 0) * h(2, 2) - h(0, 2) * h(2, 0);
  const T m2 = h(0, 0) * h(1, 1) - h(0, 1) * h(1, 0);
  const T determinant = h(0, 0) * m0 - h(0, 1) * (h(1, 0) * h(2, 2) - h(1, 2) * h(2, 0)) +
                        h(0, 2) * (h(1, 0) * h(2, 1) - h(1, 1) * h(2, 0));
  return (h(0, 0) + h(1, 1) + h(2, 2)) + (m0 + m1 + m2) + determinant;
}

/// Of H = grad d.
template <class T>
inline Deformation<T> deformation(const Mat3<T>& displacement_gradient) {
  Deformation<T> f;
  f.gradient = displacement_gradient;
  for (int i = 0; i < 3; ++i) f.gradient(i, i) += Pack(1.0);
  f.cofactor_gradient = cofactor(f.gradient);
  f.volume_change = volume_change(displacement_gradient);
  f.volume_ratio = f.volume_change + 1.0;
  return f;
}

}  // namespace fsi
