#pragma once

#include "fem/contributions.hpp"

namespace fsi {

/// Harmonic mesh motion: (grad d_m, grad v) = 0 with d_m given on the boundary; docs/theory.md, section 6.
struct HarmonicMeshMotion {
  template <class T>
  Integrand<T> integrand(const Mat3<T>& grad_d) const {
    Integrand<T> f;
    const T zero(0.0);
    f.source = {{zero, zero, zero}};
    f.flux = grad_d;
    f.scalar_source = zero;
    f.scalar_flux = {{zero, zero, zero}};
    return f;
  }
};

}  // namespace fsi
