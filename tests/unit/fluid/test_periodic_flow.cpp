// Periodic flow rates and their Fourier series.

#include <gtest/gtest.h>

#include <cmath>

#include "fluid/periodic_flow.hpp"
#include "support/pi.hpp"

namespace fsi::test {

namespace {

TEST(PeriodicFlow, IsLinearBetweenPointsAndFromTheLastToTheNextPeriod) {
  const PeriodicFlow flow{10, {{2, 1}, {4, 5}, {8, 3}}};
  for (double shift : {0.0, 10.0, -30.0, 1000.0}) {
    EXPECT_NEAR(flow.at(2 + shift), 1, 1e-12);
    EXPECT_NEAR(flow.at(3 + shift), 3, 1e-12);
    EXPECT_NEAR(flow.at(6 + shift), 4, 1e-12);
    EXPECT_NEAR(flow.at(8 + shift), 3, 1e-12);
    EXPECT_NEAR(flow.at(10 + shift), 2, 1e-12);
    EXPECT_NEAR(flow.at(11.5 + shift), 1.25, 1e-12);
  }
}

/// The triangle wave of amplitude 1 has cosines 8/(pi k)^2 of odd k alone, and the mean square 1/3.
TEST(PeriodicFlow, CoefficientsOfATriangleWave) {
  const PeriodicFlow wave{8, {{0, 1}, {4, -1}}};
  EXPECT_NEAR(wave.mean_square(), 1.0 / 3, 1e-15);
  for (int k = 0; k < 8; ++k) {
    const auto q = wave.coefficient(k);
    EXPECT_NEAR(q.real(), k % 2 == 1 ? 8 / (pi * pi * k * k) : 0.0, 1e-14) << k;
    EXPECT_NEAR(q.imag(), 0, 1e-14) << k;
  }
}

/// A jump: 1 for a quarter of the period, else 0. Coefficients (1 - e^(-i k pi/2)) / (i k pi).
TEST(PeriodicFlow, CoefficientsOfAPulseWithJumps) {
  const PeriodicFlow pulse{4, {{0, 1}, {1, 1}, {1, 0}, {4, 0}}};
  EXPECT_NEAR(pulse.mean_square(), 0.25, 1e-15);
  EXPECT_NEAR(pulse.coefficient(0).real(), 0.25, 1e-15);
  EXPECT_EQ(pulse.at(0.999), 1);
  EXPECT_EQ(pulse.at(1), 0);
  for (int k = 1; k < 6; ++k) {
    const auto expected = (1.0 - std::polar(1.0, -0.5 * k * pi)) / std::complex<double>(0, k * pi);
    EXPECT_LT(std::abs(pulse.coefficient(k) - expected), 1e-14) << k;
  }
}

TEST(PeriodicFlow, OnePointIsAConstantRate) {
  const PeriodicFlow constant{4, {{0, 7}}};
  EXPECT_EQ(constant.at(3.3), 7);
  EXPECT_NEAR(constant.coefficient(0).real(), 7, 1e-14);
  EXPECT_NEAR(std::abs(constant.coefficient(1)), 0, 1e-14);
}

}  // namespace

}  // namespace fsi::test
