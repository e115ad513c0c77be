#pragma once

#include <cmath>
#include <complex>

namespace fsi {

/// Bessel functions J_0 and J_1 of a complex argument, times e^(-|Im z|), so that they stay finite. Errors are below
/// 1e-13 of the larger of the two for |z| up to 1000 (4e-14 against 40 digits). From [Abramowitz1964]:
/// the power series 9.1.10 below |z| = 1, backward recurrence 9.1.27 with the sum 9.1.41 as its scale up to 25
/// (Miller), Hankel's asymptotic expansion 9.2.5 above.
struct ScaledBessel {
  std::complex<double> j0, j1;

  explicit ScaledBessel(std::complex<double> z) {
    const bool turned = z.real() < 0;  // J_0 is even, J_1 odd
    if (turned) z = -z;
    const double size = std::abs(z);
    if (size < 1)
      set_by_series(z);
    else if (size <= 25)
      set_by_recurrence(z);
    else
      set_by_asymptotics(z);
    if (turned) j1 = -j1;
  }

 private:
  using Complex = std::complex<double>;

  void set_by_series(Complex z) {
    const Complex square = -0.25 * z * z;
    Complex term = std::exp(-std::abs(z.imag()));
    for (int k = 0; k < 16; ++k) {
      j0 += term;
      j1 += term / (k + 1.0);
      term *= square / ((k + 1.0) * (k + 1.0));
    }
    j1 *= 0.5 * z;
  }

  /// J_(k-1) = 2 k/z J_k - J_(k+1) downwards from where J is negligible; e^(-i s z) = J_0 + 2 sum (-i s)^k J_k gives
  /// the scale, with s the sign of Im z: no term of the sum is larger than it.
  void set_by_recurrence(Complex z) {
    const double sign = z.imag() < 0 ? -1 : 1;
    const Complex turn(0, -sign);
    Complex above = 0, at = 1e-280, sum = 0;
    const int first = 4 * ((static_cast<int>(std::abs(z)) + 60) / 4);  // (-i s)^first = 1
    Complex power = 1;
    for (int k = first; k > 0; --k) {
      sum += 2.0 * power * at;
      power *= -turn;  // 1 / (-i s) = i s
      const Complex below = 2.0 * k / z * at - above;
      above = at;
      at = below;
    }
    sum += at;
    const Complex scale = std::polar(1.0, -sign * z.real()) / sum;  // e^(-i s z) e^(-|Im z|) = e^(-i s Re z)
    j0 = at * scale;
    j1 = above * scale;
  }

  void set_by_asymptotics(Complex z) {
    j0 = hankel(0, z);
    j1 = hankel(1, z);
  }
  /// sqrt(2/(pi z)) (P cos chi - Q sin chi), chi = z - (order/2 + 1/4) pi, for Re z >= 0.
  static Complex hankel(int order, Complex z) {
    constexpr double pi = 3.14159265358979323846;
    const double mu = 4.0 * order * order;
    Complex p = 1, q = 0, term = 1;
    for (int k = 1; k <= 40; ++k) {
      const double odd = 2.0 * k - 1;
      term *= (mu - odd * odd) / (8.0 * k) / z;
      if (k % 2 == 1)
        q += k % 4 == 1 ? term : -term;
      else
        p += k % 4 == 0 ? term : -term;
      if (std::abs(term) < 1e-17) break;
    }
    const double shift = (0.5 * order + 0.25) * pi, decay = std::abs(z.imag());
    const Complex i(0, 1);
    const Complex up = std::exp(i * (z - shift) - decay), down = std::exp(-i * (z - shift) - decay);
    return std::sqrt(2.0 / (pi * z)) * 0.5 * ((up + down) * p + i * (up - down) * q);
  }
};

}  // namespace fsi
