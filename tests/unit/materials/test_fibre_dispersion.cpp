// The artery's law with dispersed fibres [Gasser2006].

#include <gtest/gtest.h>

#include <cmath>

#include "materials/material.hpp"
#include "materials/varying_law.hpp"
#include "support/differences.hpp"
#include "support/random.hpp"

namespace fsi::test {

namespace {

const double alpha = 29 * std::acos(-1.0) / 180;
const Artery dispersed{3.0, 2.3632, 0.8393, 1, 29, 0.226}, parallel{3.0, 2.3632, 0.8393, 1, 29};

Fibres fibres_at(double angle) {
  Fibres f;
  f.direction[0] = {{Pack(0.0), Pack(std::cos(angle)), Pack(std::sin(angle))}};
  f.direction[1] = {{Pack(0.0), Pack(std::cos(angle)), Pack(-std::sin(angle))}};
  return f;
}

/// Strain of an isochoric stretch l along the circumference, alike across.
Strain<Pack> pulled(double l) {
  Mat3<Pack> h;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) h(i, j) = Pack(i != j ? 0.0 : i == 1 ? l - 1 : 1 / std::sqrt(l) - 1);
  return strain_of(h);
}

// W = c10/2 (l^2 + 2/l - 3) + k1/k2 (exp(k2 E^2) - 1) with
// E = kappa (l^2 + 2/l - 3) + (1 - 3 kappa) (l^2 cos^2 + sin^2/l - 1): the Cauchy stress difference is l dW/dl, by hand.
TEST(FibreDispersion, UniaxialStretchByHand) {
  for (double kappa : {0.0, 0.1, 0.226, 1.0 / 3})
    for (double l : {1.05, 1.3}) {
      DispersedArtery law{parallel};
      law.kappa = kappa;
      const double k1 = parallel.k1, k2 = parallel.k2;
      const double c = std::cos(alpha) * std::cos(alpha), s = 1 - c;
      const double e = kappa * (l * l + 2 / l - 3) + (1 - 3 * kappa) * (l * l * c + s / l - 1);
      const double slope = kappa * (2 * l - 2 / (l * l)) + (1 - 3 * kappa) * (2 * l * c - s / (l * l));
      ASSERT_GT(e, 0);
      const double w = 1.5 * (l * l + 2 / l - 3) + k1 / k2 * std::expm1(k2 * e * e);
      const double difference = l * (3 * (l - 1 / (l * l)) + 2 * k1 * e * std::exp(k2 * e * e) * slope);
      const auto strain = pulled(l);
      EXPECT_NEAR(law.energy(strain, fibres_at(alpha))[0], w, 1e-13);
      const auto stress = law.stress(strain, fibres_at(alpha));
      // The families shear nothing together; across, radial and axial directions differ where fibres are not round.
      const double across = (stress.c[0][0] + stress.c[2][0]) / (2 * l);
      EXPECT_NEAR(stress.c[1][0] * l * l - across, difference, 1e-12);
    }
}

TEST(FibreDispersion, EvenDispersionKnowsNoDirection) {
  DispersedArtery law{parallel};
  law.kappa = 1.0 / 3;
  Random random(3);
  Mat3<Pack> h;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) h(i, j) = Pack(0.3 * random());
  const auto strain = strain_of(h);
  const auto one = law.stress(strain, fibres_at(alpha)), other = law.stress(strain, fibres_at(1.3));
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(one.c[k][0], other.c[k][0], 1e-13);
  EXPECT_NEAR(law.energy(strain, fibres_at(alpha))[0], law.energy(strain, fibres_at(1.3))[0], 1e-14);
  EXPECT_NEAR(law.fibre_stiffness(), 0, 1e-14);
}

TEST(FibreDispersion, StressIsTheDerivativeOfTheEnergyOnBothSidesOfSlackFibres) {
  const auto fibres = fibres_at(alpha);
  for (const auto& stretches : {std::array{-0.2, 0.3, 0.1}, std::array{0.3, -0.15, -0.1}}) {
    Random random(4);
    Mat3<Pack> h;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) h(i, j) = Pack(0.05 * random() + (i == j ? stretches[i] : 0));
    Mat3<Pack> direction;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) direction(i, j) = Pack(0.3 * random());
    const auto flux = [&](const Mat3<Pack>& at) {
      const auto f = deformation(at);
      return f.gradient * DispersedArtery{dispersed}.stress(strain_of(at, f), fibres);
    };
    const double power = contract(flux(h), direction)[0];
    expect_second_order(central_differences("P = dPsi/dF",
                                            [&](double t) {
                                              return std::vector<double>{DispersedArtery{dispersed}.energy(
                                                  strain_of(h + Pack(t) * direction), fibres)[0]};
                                            },
                                            {power}));
  }
}

TEST(FibreDispersion, IsALawOfItsOwnOnlyWhereThereIsAny) {
  EXPECT_TRUE(std::holds_alternative<Artery>(element_law(parallel)));
  EXPECT_TRUE(std::holds_alternative<DispersedArtery>(element_law(dispersed)));
}

TEST(FibreDispersion, SoftensTheCircumference) {
  EXPECT_NEAR(dispersed.fibre_stiffness(), std::pow(1 - 3 * 0.226, 2) * parallel.fibre_stiffness(), 1e-14);
}

}  // namespace

}  // namespace fsi::test
