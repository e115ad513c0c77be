#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/error.hpp"
#include "materials/material.hpp"

namespace fsi::test {

namespace {

TEST(MaterialTable, MakesEachLawFromItsParameters) {
  const auto neo_hookean = std::get<NeoHookean>(make_material("neo-hookean", {{"c10", 3}}));
  EXPECT_EQ(neo_hookean.c10, 3);
  const auto rivlin = std::get<MooneyRivlin>(make_material("mooney-rivlin", {{"c10", 3}, {"c01", 0.3}}));
  EXPECT_EQ(rivlin.c10, 3);
  EXPECT_EQ(rivlin.c01, 0.3);
  const auto artery = std::get<Artery>(make_material("artery", {{"c10", 3}, {"k1", 2.4}, {"k2", 0.8}, {"alpha", 29}}));
  EXPECT_EQ(artery.c10, 3);
  EXPECT_EQ(artery.k1, 2.4);
  EXPECT_EQ(artery.k2, 0.8);
  EXPECT_EQ(artery.alpha, 29);
  EXPECT_EQ(artery.fibre_scale, 1) << "its default";
}

std::string complaint(const std::string& name, const ParameterValues& values) {
  try {
    make_material(name, values);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MaterialTable, RefusesWhatDoesNotMakeAMaterial) {
  EXPECT_EQ(complaint("neohookean", {{"c10", 3}}),
            "material: \"neohookean\" is unknown; did you mean neo-hookean? There are " + one_of(materials().names()));
  EXPECT_EQ(complaint("mooney-rivlin", {{"c10", 3}}),
            "parameter of mooney-rivlin: c01 is missing; give it (second isotropic stiffness)");
  EXPECT_EQ(complaint("mooney-rivlin", {{"c10", 3}, {"c1O", 3}}),
            "parameter of mooney-rivlin: \"c1O\" is unknown; did you mean c10? There are c10 or c01");
}

TEST(MaterialTable, KnowsWhatTheMembraneAndTheLimitLoadNeed) {
  const auto rivlin = make_material("mooney-rivlin", {{"c10", 3}, {"c01", 0.5}});
  EXPECT_EQ(shear_modulus(rivlin), 3.5);
  EXPECT_EQ(fibre_stiffness(rivlin), 0);
  EXPECT_EQ(inflation_modulus(rivlin), 3.5);
  EXPECT_FALSE(has_fibres(rivlin));
  EXPECT_EQ(fibre_angle(rivlin), 0);

  const auto artery = make_material("artery", {{"c10", 3}, {"k1", 2}, {"k2", 1}, {"alpha", 60}, {"fibre_scale", 0.5}});
  EXPECT_EQ(shear_modulus(artery), 3);
  EXPECT_NEAR(fibre_stiffness(artery), 8 * 0.5 * 2 / 16.0, 1e-14) << "cos 60 degrees = 1/2";
  EXPECT_EQ(inflation_modulus(artery), std::nullopt) << "fibres bear any pressure";
  EXPECT_TRUE(has_fibres(artery));
  EXPECT_EQ(materials_with_fibres(), (std::vector<std::string>{"artery", "holzapfel-gasser-ogden"}));
  EXPECT_NEAR(fibre_angle(artery), std::acos(0.5), 1e-15);
  EXPECT_EQ(inflation_modulus(make_material("artery", {{"c10", 3}, {"k1", 0}, {"k2", 1}, {"alpha", 60}})), 3.0);
}

TEST(MaterialTable, TwoFamiliesAreAlikeUnlessTheSecondHasConstants) {
  const ParameterValues first{{"c10", 3}, {"k1", 2}, {"k2", 0.8}, {"alpha", 60}};
  const auto alike = std::get<HolzapfelGasserOgden>(make_material("holzapfel-gasser-ogden", first));
  EXPECT_EQ(alike.k1_second, 2);
  EXPECT_EQ(alike.k2_second, 0.8);
  ParameterValues both = first;
  both["k1_second"] = 0;
  EXPECT_NE(complaint("holzapfel-gasser-ogden", both).find("k1, k2 and k1_second together are no set"),
            std::string::npos)
      << complaint("holzapfel-gasser-ogden", both);
  both["k2_second"] = 1;
  const auto one = make_material("holzapfel-gasser-ogden", both);
  EXPECT_EQ(std::get<HolzapfelGasserOgden>(one).k1_second, 0);
  EXPECT_NEAR(fibre_stiffness(one), 4 * 2 / 16.0, 1e-14) << "one family, cos 60 degrees = 1/2";
  EXPECT_EQ(inflation_modulus(one), std::nullopt);
  EXPECT_EQ(inflation_modulus(make_material("yeoh", {{"c10", 3}})), 3.0);
  EXPECT_EQ(inflation_modulus(make_material("yeoh", {{"c10", 3}, {"c30", 1}})), std::nullopt);
}

// Young's modulus along the circumference at small strains, against the laws' own stress: what fibres add to the stress
// difference of an incompressible strip pulled along the circumference, over the strain.
TEST(MaterialTable, FibreStiffnessIsTheSlopeOfTheFibreStressAtRest) {
  const double alpha = 29, eps = 1e-5, c = std::cos(alpha * std::acos(-1.0) / 180);
  const Artery with{3, 2.4, 0.8, 1, alpha}, without{3, 0, 0.8, 1, alpha};
  // Membrane: the circumference stretches, the length is held, the thickness follows.
  const double l2 = (1 + eps) * (1 + eps);
  const Sym3<Pack> change{{Pack(1 / l2 - 1), Pack(l2 - 1), Pack(0.0), Pack(0.0), Pack(0.0), Pack(0.0)}};
  const Strain<Pack> strain = strain_from(change, Pack(0.0));
  Fibres fibres;
  fibres.direction[0] = {{Pack(0.0), Pack(c), Pack(std::sqrt(1 - c * c))}};
  fibres.direction[1] = {{Pack(0.0), Pack(c), Pack(-std::sqrt(1 - c * c))}};
  const auto difference = [&](const Artery& law) {
    const auto s = law.stress(strain, fibres);
    return s.c[1][0] * l2 - s.c[0][0] / l2;
  };
  EXPECT_NEAR((difference(with) - difference(without)) / eps, fibre_stiffness(with), 1e-3 * fibre_stiffness(with));
}

}  // namespace

}  // namespace fsi::test
