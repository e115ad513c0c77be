// Bessel functions of complex arguments.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "math/bessel.hpp"

namespace fsi::test {

namespace {

using Complex = std::complex<double>;

void expect_near(Complex value, Complex expected, double error) {
  EXPECT_NEAR(value.real(), expected.real(), error);
  EXPECT_NEAR(value.imag(), expected.imag(), error);
}

/// Expected: 40 digits of mpmath, times e^(-|Im z|).
TEST(Bessel, AgreesWithManyDigitsOnTheRayOfOscillatingFlow) {
  struct Row {
    double size;
    Complex j0, j1;
  };
  const Row rows[] = {
      {2, {0.182759159663954, 0.2363803653485235}, {-0.2424062627136874, 0.07288042530752389}},
      {12, {-0.02653576062692898, 0.1129368314543947}, {-0.1088101988304391, -0.02918665332716374}},
      {40, {-0.05858989542419381, 0.0237426803458943}, {-0.02301033290875771, -0.05828385981237142}},
      {200, {-0.02657369053633971, 0.009503544629925434}, {-0.009439685255653864, -0.02654354459696092}},
  };
  for (const auto& row : rows) {
    const ScaledBessel b(std::polar(row.size, 0.75 * std::acos(-1.0)));
    expect_near(b.j0, row.j0, 2e-14);
    expect_near(b.j1, row.j1, 2e-14);
  }
}

TEST(Bessel, AgreesWithTheStandardLibraryOnTheRealAxis) {
  for (double x : {0.0, 0.4, 1.0, 3.0, 11.0, 24.9, 25.1, 60.0}) {
    const ScaledBessel b(x), mirrored(-x);
    expect_near(b.j0, std::cyl_bessel_j(0, x), 2e-13);
    expect_near(b.j1, std::cyl_bessel_j(1, x), 2e-13);
    expect_near(mirrored.j0, b.j0, 1e-16);
    expect_near(mirrored.j1, -b.j1, 1e-16);
  }
}

/// J_1(i x) = i I_1(x), of modified functions.
TEST(Bessel, AgreesWithTheStandardLibraryOnTheImaginaryAxis) {
  for (double x : {0.7, 2.0, 20.0, 40.0}) {
    const ScaledBessel b(Complex(0, x));
    expect_near(b.j0, std::exp(-x) * std::cyl_bessel_i(0, x), 2e-14);
    expect_near(b.j1, Complex(0, std::exp(-x) * std::cyl_bessel_i(1, x)), 2e-14);
  }
}

/// The power series in extended precision, whose terms cancel by e^(|z| - |Im z|): 1500 at |z| = 25 on this ray.
TEST(Bessel, MethodsMeetWhereOneTakesOverFromTheOther) {
  using Long = std::complex<long double>;
  for (double angle : {0.75, 0.5, -0.4, -0.75})
    for (double size : {0.999, 1.0, 1.001, 24.999, 25.001}) {
      const Complex z = std::polar(size, angle * std::acos(-1.0));
      const Long square = -0.25L * Long(z) * Long(z);
      Long term = std::exp(-std::abs(static_cast<long double>(z.imag()))), j0 = 0, j1 = 0;
      for (int k = 0; k < 120; ++k) {
        j0 += term;
        j1 += term / (k + 1.0L);
        term *= square / ((k + 1.0L) * (k + 1.0L));
      }
      j1 *= 0.5L * Long(z);
      const ScaledBessel b(z);
      expect_near(b.j0, Complex(j0), 3e-14);
      expect_near(b.j1, Complex(j1), 3e-14);
    }
}

TEST(Bessel, StaysFiniteWhereTheFunctionItselfDoesNot) {
  const ScaledBessel b(Complex(3, 900));
  EXPECT_NEAR(std::abs(b.j0), 1 / std::sqrt(2 * std::acos(-1.0) * 900), 1e-5);
}

}  // namespace

}  // namespace fsi::test
