// What a case file can say wrong about the law of its fluid's viscosity: one clear line each.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/error.hpp"
#include "case/case_hash.hpp"
#include "case/case_reader.hpp"
#include "example_cases.hpp"
#include "materials/viscosity_law.hpp"

namespace fsi::test {

namespace {

std::string with_model(const std::string& model, const std::string& viscosity = "") {
  std::string text = fluid_case;
  const std::string constant = "viscosity = 3.5e-3";
  return text.replace(text.find(constant), constant.size(), viscosity + "\nviscosity_model = " + model);
}
std::string complaint_about_model(const std::string& model, const std::string& viscosity = "") {
  try {
    parse_case(with_model(model, viscosity), "case.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

const std::string carreau = "name = \"carreau-yasuda\", mu0 = 0.056, mu_inf = 0.0035, lambda = 3313.0, n = 0.36";

TEST(BadViscosityModel, IsRefusedInOneLine) {
  const std::string here = "case.toml:7: fluid.viscosity_model";
  EXPECT_EQ(complaint_about_model("{ name = \"cason\" }"),
            here +
                ".name: \"cason\" is unknown; did you mean casson? There are newtonian, carreau-yasuda, casson or "
                "power-law");
  EXPECT_EQ(complaint_about_model("\"casson\""),
            here +
                ": is no table; give one with the law's name and parameters, as { name = \"casson\", ... }, or leave "
                "it out");
  EXPECT_EQ(complaint_about_model("{ mu0 = 1.0 }"),
            here +
                ".name: missing; add it (the law of the viscosity: newtonian (default), carreau-yasuda, casson or "
                "power-law)");
  EXPECT_EQ(complaint_about_model("{ nam = \"casson\" }"),
            here + ".nam: unknown key; did you mean fluid.viscosity_model.name?");
  EXPECT_EQ(complaint_about_model("{ name = \"casson\", yield_stress = 5e-6, regularisation = 1e3 }"),
            here + ".plastic_viscosity: missing; add it (viscosity at high shear rates in kPa ms)");
  EXPECT_EQ(complaint_about_model("{ name = \"casson\", yield_stres = 5e-6 }"),
            here + ".yield_stres: unknown key; did you mean fluid.viscosity_model.yield_stress?");
  EXPECT_EQ(complaint_about_model("{ name = \"casson\", yield_stress = -0.5 }"),
            here + ".yield_stress: -0.5 is negative; give a number >= 0 (yield stress in kPa)");
  EXPECT_EQ(complaint_about_model("{ name = \"casson\", mu0 = 1.0 }"),
            here +
                ".mu0: is no parameter of casson but of carreau-yasuda; remove it (casson takes yield_stress, "
                "plastic_viscosity or regularisation)");
  EXPECT_EQ(complaint_about_model("{ name = \"carreau-yasuda\", mu0 = -0.056 }"),
            here + ".mu0: -0.056 is not positive; give a number > 0 (viscosity at rest in kPa ms)");
  EXPECT_EQ(
      complaint_about_model("{ name = \"carreau-yasuda\", mu0 = 0.003, mu_inf = 0.05, lambda = 1, n = 0.4 }"),
      here + ".mu_inf: 0.05 is more than mu0, 0.003; give at most 0.003 (viscosity at high shear rates in kPa ms)");
  EXPECT_EQ(complaint_about_model("{ name = \"power-law\", consistency = 0.01, exponent = 2.5 }"),
            here + ".exponent: 2.5 is out of range; give a number > 0 and <= 2 (exponent)");
  EXPECT_EQ(
      complaint_about_model("{ name = \"power-law\", consistency = 0.01, exponent = 0.6, lowest_viscosity = 0.2, "
                            "highest_viscosity = 0.1 }"),
      here + ".lowest_viscosity: 0.2 is more than highest_viscosity, 0.1; give at most 0.1 (lower limit in kPa ms)");
  EXPECT_EQ(complaint_about_model("{ name = \"newtonian\", mu0 = 1.0 }", "viscosity = 1.0"),
            here +
                ".mu0: is no parameter of newtonian but of carreau-yasuda; remove it "
                "(newtonian takes none: fluid.viscosity is all)");
  EXPECT_EQ(complaint_about_model("{ name = \"newtonian\" }"),
            "case.toml:4: fluid.viscosity: missing; add it (dynamic viscosity in kPa ms)");
}

TEST(ViscosityModel, IsReadWithTheViscosityThatStandsForIt) {
  const Case given = parse_case(with_model("{ " + carreau + " }", "viscosity = 4e-3"), "case.toml");
  EXPECT_EQ(given.fluid->viscosity, 4e-3);
  ASSERT_TRUE(given.fluid->viscosity_model);
  EXPECT_EQ(given.fluid->viscosity_model->values.at("lambda"), 3313);
  EXPECT_TRUE(given.remarks.empty());

  const Case chosen = parse_case(with_model("{ " + carreau + " }"), "case.toml");
  EXPECT_NEAR(chosen.fluid->viscosity, viscosity_at(CarreauYasuda{0.056, 0.0035, 3313, 2, 0.36}, 0.1), 1e-15);
  ASSERT_EQ(chosen.remarks.size(), 1u);
  EXPECT_NE(chosen.remarks[0].find("carreau-yasuda at 100 1/s"), std::string::npos) << chosen.remarks[0];
}

TEST(ViscosityModel, IsPartOfTheHashUnlessItIsNewtons) {
  const Case plain = parse_case(fluid_case, "case.toml");
  const auto hash = [](const std::string& model) {
    return hash_of_case(parse_case(with_model(model, "viscosity = 3.5e-3"), "case.toml"));
  };
  EXPECT_EQ(hash("{ name = \"newtonian\" }"), hash_of_case(plain));
  EXPECT_NE(hash("{ " + carreau + " }"), hash_of_case(plain));
  EXPECT_NE(hash("{ " + carreau + " }"), hash("{ " + carreau + ", a = 1.0 }"));
  EXPECT_EQ(hash("{ " + carreau + " }"), hash("{ " + carreau + ", a = 2.0 }"));
}

}  // namespace

}  // namespace fsi::test
