#pragma once

#include "fem/contributions.hpp"

namespace fsi {

/// Harmonic mesh motion: (k grad d_m, grad v) = 0 with d_m given on the boundary; docs/theory.md, section 6.
struct HarmonicMeshMotion {
  /// \param stiffness  k of the elements; 1 unless the motion is stiffened
  template <class T>
  Integrand<T> integrand(const Mat3<T>& grad_d, Pack stiffness = Pack(1.0)) const {
    Integrand<T> f;
    const T zero(0.0);
    f.source = {{zero, zero, zero}};
    f.flux = stiffness * grad_d;
    f.scalar_source = zero;
    f.scalar_flux = {{zero, zero, zero}};
    return f;
  }
};

}  // namespace fsi
