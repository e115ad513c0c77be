#pragma once

#include "fem/contributions.hpp"
#include "math/kinematics.hpp"

namespace fsi {

/// What a Kelvin-Voigt layer adds to an elastic one: a second Piola-Kirchhoff stress proportional to the rate of the
/// Green-Lagrange strain, and so (docs/theory.md, section 5.10)
///   (eta F dE/dt, grad w),   dE/dt = (F^T grad v + (F^T grad v)^T) / 2,   F = I + grad d - s grad v,
/// to the wall's residual, for test functions w. It takes the power eta dE/dt : dE/dt, never negative. v is the difference
/// of two displacements over a time; with the lag s F is the mean of theirs, and dE/dt the difference of their strains over
/// that time: zero between two places of a rigid body, however far apart.
struct KelvinVoigt {
  double viscosity;  ///< eta, kPa ms
  double lag = 0;    ///< s, ms

  template <class T>
  struct Prepared {
    Mat3<T> flux;  ///< eta F dE/dt, kPa
    T power;       ///< of it, per volume at rest, kPa/ms
  };

  /// \param grad_d  from the unloaded shape \param grad_v  1/ms, on the same
  template <class T>
  Prepared<T> prepare(const Mat3<T>& grad_d, const Mat3<T>& grad_v) const {
    Mat3<T> f = grad_d;
    if (lag != 0)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) f(i, j) -= Pack(lag) * grad_v(i, j);
    for (int i = 0; i < 3; ++i) f(i, i) += Pack(1.0);
    Mat3<T> rate;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j) {
        T sum = f(0, i) * grad_v(0, j) + f(0, j) * grad_v(0, i);
        for (int k = 1; k < 3; ++k) sum += f(k, i) * grad_v(k, j) + f(k, j) * grad_v(k, i);
        rate(i, j) = rate(j, i) = Pack(0.5 * viscosity) * sum;
      }
    return {f * rate, Pack(1.0 / viscosity) * contract(rate, rate)};
  }

  /// The term at a point: a flux, and nothing else.
  template <class T>
  Integrand<T> integrand(const Prepared<T>& k) const {
    Integrand<T> f;
    for (int i = 0; i < 3; ++i) f.source[i] = f.scalar_flux[i] = T(0.0);
    f.scalar_source = T(0.0);
    f.flux = k.flux;
    return f;
  }
};

}  // namespace fsi
