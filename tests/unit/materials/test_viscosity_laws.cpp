// Laws of a fluid's viscosity: values by hand, limits, and derivatives by differences.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "materials/viscosity_law.hpp"

namespace fsi::test {

namespace {

const CarreauYasuda blood{0.056, 0.00345, 3313, 2, 0.3568};  // [ChoKensey1991]
const Casson casson{5e-6, 3.5e-3, 1e4};
const PowerLaw power_law{0.0167, 0.63, 2e-3, 0.3};

TEST(ViscosityLaws, CarreauYasudaByHand) {
  // 1 + (3313 * 0.01)^2 = 1098.5969, to the power (0.3568 - 1)/2 = -0.3216
  EXPECT_NEAR(viscosity_at(blood, 0.01), 0.00345 + 0.05255 * std::exp(-0.3216 * std::log(1098.5969)), 1e-12);
  // n = 0: a shear stress that stays, (mu_0 - mu_inf) / lambda, beside that of mu_inf; a = 1: mu_inf + ... / (1 + lambda g)
  EXPECT_NEAR(viscosity_at(CarreauYasuda{3, 1, 2, 1, 1e-300}, 5), 1 + 2.0 / 11, 1e-14);
  EXPECT_NEAR(viscosity_at(blood, 0), 0.056, 1e-9);
  EXPECT_NEAR(viscosity_at(blood, 1e12), 0.00345, 1e-8);
}

TEST(ViscosityLaws, CassonIsThatOfItsStressWhereFluidFlows) {
  // sqrt(tau) = sqrt(tau_y) + sqrt(mu_p g); m g = 1000, so that exp(-sqrt(m g)) is of the size of rounding
  const double g = 0.1, root = std::sqrt(5e-6) + std::sqrt(3.5e-3 * g);
  EXPECT_NEAR(viscosity_at(casson, g) * g, root * root, 1e-15);
  const double at_rest = std::sqrt(3.5e-3) + std::sqrt(5e-6 * 1e4);
  // at the lowest shear rate: 1 - exp(-x) is x less x^2/2, x^2 = m g = 1e-5
  EXPECT_NEAR(viscosity_at(casson, 0), at_rest * at_rest, 3e-3 * at_rest * at_rest);
  EXPECT_NEAR(viscosity_at(Casson{0, 3.5e-3, 1e4}, 0.2), 3.5e-3, 1e-17) << "Newton's";
}

TEST(ViscosityLaws, PowerLawKeepsToItsLimits) {
  EXPECT_NEAR(viscosity_at(power_law, 1), 0.0167, 1e-16);
  EXPECT_NEAR(viscosity_at(power_law, 1.0 / 32), 0.0167 * std::pow(32, 0.37), 1e-15);
  EXPECT_EQ(viscosity_at(power_law, 0), 0.3);
  EXPECT_EQ(viscosity_at(power_law, 1e6), 2e-3);
  EXPECT_EQ(viscosity_at(PowerLaw{0.0167, 1.5, 2e-3, 0.3}, 0), 2e-3) << "one that thickens";
  const auto thick = shear_viscosity(power_law, Pack(1e-12)), thin = shear_viscosity(power_law, Pack(1e12));
  EXPECT_EQ(thick.slope[0], 0);
  EXPECT_EQ(thin.slope[0], 0);
}

TEST(ViscosityLaws, SlopesAreThoseOfDifferences) {
  const std::pair<const char*, ViscosityLaw> laws[] = {
      {"carreau-yasuda", CarreauYasuda{0.16, 0.0035, 8200, 0.64, 0.2128}},
      {"casson", casson},
      {"power-law", power_law}};
  for (const auto& [name, law] : laws)
    for (const double g : {0.002, 0.03, 0.5, 8.0}) {
      const double s = g * g;
      const auto difference = [&, of = law](double step) {
        return (shear_viscosity(of, Pack(s * (1 + step))).value[0] -
                shear_viscosity(of, Pack(s * (1 - step))).value[0]) /
               (2 * s * step);
      };
      const double exact = shear_viscosity(law, Pack(s)).slope[0];
      const double coarse = difference(0.04) / exact - 1, fine = difference(0.02) / exact - 1;
      EXPECT_NEAR(coarse / fine, 4, 0.1) << name << " at " << g;
      EXPECT_LT(std::abs(fine), 1e-3) << name << " at " << g;
    }
}

TEST(ViscosityLaws, FluidAtRestHasAViscosityAndNoSlope) {
  for (const auto& law : {ViscosityLaw(blood), ViscosityLaw(casson), ViscosityLaw(power_law)}) {
    const auto rest = shear_viscosity(law, Pack(0.0));
    EXPECT_GT(rest.value[0], 0);
    EXPECT_TRUE(std::isfinite(rest.value[0]));
    EXPECT_EQ(rest.slope[0], 0);
  }
}

TEST(ViscosityLaws, ShearRateOfASimpleShearAndOfAStretch) {
  Mat3<Pack> shear{};
  shear(0, 1) = Pack(3.0);
  EXPECT_EQ(shear_rate_squared(shear)[0], 9);
  Mat3<Pack> stretch{};
  stretch(0, 0) = Pack(2.0);
  stretch(1, 1) = stretch(2, 2) = Pack(-1.0);
  EXPECT_EQ(shear_rate_squared(stretch)[0], 12);  // sqrt(3) times the rate of stretch
  Mat3<Pack> turn{};
  turn(0, 1) = Pack(3.0);
  turn(1, 0) = Pack(-3.0);
  EXPECT_EQ(shear_rate_squared(turn)[0], 0);
}

TEST(ViscosityLaws, TheTableMakesThemAndFindsWhatContradictsItself) {
  const auto made =
      viscosity_laws().at("casson").make({{"yield_stress", 1}, {"plastic_viscosity", 2}, {"regularisation", 3}});
  EXPECT_EQ(std::get<Casson>(made).regularisation, 3);
  EXPECT_FALSE(problem_of(made));
  EXPECT_EQ(std::get<CarreauYasuda>(viscosity_laws().at("carreau-yasuda").make({{"mu0", 1}})).a, 2) << "its default";
  EXPECT_EQ(problem_of(CarreauYasuda{1, 2, 1, 2, 0.5})->parameter, "mu_inf");
  EXPECT_EQ(problem_of(PowerLaw{1, 0.5, 2, 1})->parameter, "lowest_viscosity");
}

}  // namespace

}  // namespace fsi::test
