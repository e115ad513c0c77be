#include <gtest/gtest.h>

#include <cmath>

#include "math/kinematics.hpp"
#include "support/random.hpp"

namespace fsi::test {

namespace {

Mat3<Pack> random_gradient(double size, unsigned seed) {
  Random random(seed);
  Mat3<Pack> h;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) h(i, j) = Pack(size * random());
  return h;
}

/// det(I + H) - 1 in long double.
long double reference_volume_change(const Mat3<Pack>& h) {
  long double f[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) f[i][j] = static_cast<long double>(h(i, j)[0]);
  const auto minor2 = [&](int a, int b) { return f[a][a] * f[b][b] - f[a][b] * f[b][a]; };
  const long double det = f[0][0] * minor2(1, 2) - f[0][1] * (f[1][0] * f[2][2] - f[1][2] * f[2][0]) +
                          f[0][2] * (f[1][0] * f[2][1] - f[1][1] * f[2][0]);
  return (f[0][0] + f[1][1] + f[2][2]) + (minor2(1, 2) + minor2(0, 2) + minor2(0, 1)) + det;
}

TEST(VolumeChange, IsDetMinusOneWithoutCancellation) {
  for (unsigned seed = 1; seed <= 20; ++seed)
    for (const double size : {0.3, 1e-3, 1e-6, 1e-9, 1e-12}) {
      const auto h = random_gradient(size, seed);
      const auto exact = static_cast<double>(reference_volume_change(h));
      // Rounding of the terms summed: a few units of 1e-16 of the largest, tr H, not of 1 as in det(F) - 1.
      EXPECT_NEAR(volume_change(h)[0], exact, 5e-16 * size * (1 + 3 * size)) << size;
    }
}

// A dilatation by e = 1e-12 has J - 1 = 3 e + 3 e^2 + e^3, of which the formula det(F) - 1 keeps four digits.
TEST(VolumeChange, OfATinyDilatationIsAccurateToTheLastDigit) {
  const double e = 1e-12;
  Mat3<Pack> h = random_gradient(0, 1);
  for (int i = 0; i < 3; ++i) h(i, i) = Pack(e);
  EXPECT_NEAR(volume_change(h)[0] / (3 * e + 3 * e * e), 1.0, 4e-16);
  const double cancelled = (1 + e) * (1 + e) * (1 + e) - 1;
  EXPECT_GT(std::abs(cancelled / (3 * e) - 1), 1e-6) << "the control: the naive formula fails";
}

TEST(Deformation, HoldsFCofactorAndVolume) {
  const auto h = random_gradient(0.4, 3);
  const auto f = deformation(h);
  const double j = 1 + static_cast<double>(reference_volume_change(h));
  EXPECT_NEAR(f.volume_ratio[0], j, 1e-15);
  EXPECT_NEAR(f.volume_change[0], j - 1, 1e-15);
  const auto product = times_transposed(f.cofactor_gradient, f.gradient);  // cof F F^T = J I
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(f.gradient(r, c)[0], h(r, c)[0] + (r == c ? 1 : 0));
      EXPECT_NEAR(product(r, c)[0], r == c ? j : 0.0, 1e-15);
    }
}

// dJ = cof F : dH.
TEST(Deformation, DerivativeOfTheVolumeIsTheCofactor) {
  const auto h = random_gradient(0.4, 4);
  Mat3<Dual<9>> seeded;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      seeded(i, j) = Dual<9>(h(i, j));
      seeded(i, j).slope[3 * i + j] = Pack(1.0);
    }
  const auto f = deformation(seeded);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(f.volume_change.slope[3 * i + j][0], f.cofactor_gradient(i, j).value[0], 1e-15);
}

}  // namespace

}  // namespace fsi::test
