#pragma once

#include "fem/contributions.hpp"
#include "math/kinematics.hpp"

namespace fsi {

/// The mesh as a hyperelastic solid of the energy (docs/theory.md, section 6)
///   W = k (1/2 (F : F - 3) - ln J + lambda/4 (J^2 - 1 - 2 ln J)),   F = I + grad d_m,  J = det F,
/// polyconvex [Ciarlet1988], without bound as J falls to zero. At rest it has the shear modulus k and
/// lambda = 2 nu / (1 - 2 nu), nu being Poisson's ratio. (P, grad v) = 0 with its stress
///   P = dW/dF = k (F - cof F / J + lambda/2 (J - 1/J) cof F)
/// and d_m given on the boundary moves the mesh.
struct PseudoSolid {
  double lambda;  ///< over k

  static PseudoSolid of_poisson(double poisson) { return {2 * poisson / (1 - 2 * poisson)}; }

  /// Stress and J at a quadrature point: the part of the integrand that depends on the gradient.
  template <class T>
  struct Stress {
    Mat3<T> first_piola;  ///< P
    T volume_ratio;       ///< J
  };

  /// Written with H = grad d_m and J - 1, so that terms of order one do not cancel:
  ///   P = k (H - A + (J - 1)/J (1 + lambda/2 (J + 1)) cof F),   A = cof F - I = tr(H) I - H^T + cof H.
  /// \param stiffness  k of the elements
  template <class T>
  Stress<T> stress(const Mat3<T>& grad_d, Pack stiffness) const {
    const auto f = deformation(grad_d);
    const T of_volume = f.volume_change / f.volume_ratio * (Pack(0.5 * lambda) * (f.volume_ratio + 1.0) + 1.0);
    const Mat3<T> minors = cofactor(grad_d);
    const T trace_of_d = trace(grad_d);
    Stress<T> s;
    s.volume_ratio = f.volume_ratio;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        T change = minors(i, j) - grad_d(j, i);  // of cof F
        if (i == j) change += trace_of_d;
        s.first_piola(i, j) = stiffness * (grad_d(i, j) - change + of_volume * f.cofactor_gradient(i, j));
      }
    return s;
  }

  template <class T>
  Integrand<T> integrand(const Stress<T>& s) const {
    Integrand<T> f;
    const T zero(0.0);
    f.source = {{zero, zero, zero}};
    f.flux = s.first_piola;
    f.scalar_source = zero;
    f.scalar_flux = {{zero, zero, zero}};
    return f;
  }
};

}  // namespace fsi
