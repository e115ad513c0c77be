#include <gtest/gtest.h>

#include "derived/stress_invariants.hpp"

namespace fsi {

namespace {

Mat3<double> symmetric(double xx, double yy, double zz, double xy, double yz, double zx) {
  return {{{xx, xy, zx}, {xy, yy, yz}, {zx, yz, zz}}};
}

TEST(StressInvariants, TensionAndShearHaveTheirClosedForms) {
  EXPECT_DOUBLE_EQ(von_mises_stress(symmetric(7, 0, 0, 0, 0, 0)), 7);
  EXPECT_DOUBLE_EQ(von_mises_stress(symmetric(0, 0, 0, 0, 5, 0)), 5 * std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(von_mises_stress(symmetric(-1e9, -1e9, -1e9, 0, 0, 0)), 0);
  EXPECT_EQ(principal_stresses(symmetric(1, 3, 2, 0, 0, 0)), (std::array<double, 3>{3, 2, 1}));
  const auto shear = principal_stresses(symmetric(0, 0, 0, 0, 5, 0));
  EXPECT_NEAR(shear[0], 5, 1e-14);
  EXPECT_NEAR(shear[1], 0, 1e-14);
  EXPECT_NEAR(shear[2], -5, 1e-14);
}

TEST(StressInvariants, PrincipalStressesAreThoseThatWereTurned) {
  // diag(4, 1, -2) turned about (1, 1, 1) by 0.7 and about z by -1.1.
  const auto turn = [](Vec3<double> axis, double angle) {
    axis = (1 / std::sqrt(dot(axis, axis))) * axis;
    const double c = std::cos(angle), s = std::sin(angle);
    Mat3<double> q{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) q(i, j) = (1 - c) * axis[i] * axis[j] + (i == j ? c : 0);
    q(0, 1) -= s * axis[2];
    q(1, 0) += s * axis[2];
    q(0, 2) += s * axis[1];
    q(2, 0) -= s * axis[1];
    q(1, 2) -= s * axis[0];
    q(2, 1) += s * axis[0];
    return q;
  };
  const auto q = turn({{1, 1, 1}}, 0.7) * turn({{0, 0, 1}}, -1.1);
  const auto s = times_transposed(q * symmetric(4, 1, -2, 0, 0, 0), q);
  const auto found = principal_stresses(s);
  EXPECT_NEAR(found[0], 4, 1e-13);
  EXPECT_NEAR(found[1], 1, 1e-13);
  EXPECT_NEAR(found[2], -2, 1e-13);
  EXPECT_NEAR(von_mises_stress(s), std::sqrt(0.5 * (9.0 + 9.0 + 36.0)), 1e-13);
}

}  // namespace

}  // namespace fsi
