#pragma once

#include <cmath>
#include <complex>

#include "support/pi.hpp"

namespace fsi::test {

using Complex = std::complex<double>;

/// Bessel functions of orders 0 and 1 of a complex argument by their power series [Abramowitz1964, 9.1.10 to 9.1.13]:
/// for |z| up to 30, accurate to rounding times exp(|z| - |Im z|).
struct Bessel {
  Complex j0, j1, y0, y1;

  explicit Bessel(Complex z) {
    constexpr double euler = 0.57721566490153286061;
    const Complex square = -0.25 * z * z;
    Complex term = 1.0;  // (-z^2/4)^k / (k!)^2
    Complex sum0 = 0.0, sum1 = 0.0;
    double harmonic = 0;  // 1 + 1/2 + ... + 1/k
    for (int k = 0; k < 120; ++k) {
      const double next = harmonic + 1.0 / (k + 1);
      j0 += term;
      j1 += term / (k + 1.0);
      sum0 += harmonic * term;
      sum1 += (harmonic + next) / (k + 1.0) * term;
      term *= square / ((k + 1.0) * (k + 1.0));
      harmonic = next;
    }
    j1 *= 0.5 * z;
    const Complex logarithm = std::log(0.5 * z) + euler;
    y0 = 2 / pi * (logarithm * j0 - sum0);
    y1 = -2.0 / (pi * z) + 2 / pi * logarithm * j1 - z / (2 * pi) * sum1;
  }
};

}  // namespace fsi::test
