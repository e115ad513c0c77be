// The one law that stands for all with constants that vary, and for those without element loops of their own: against each
// law of the list, so that none can be missing.

#include "materials/varying_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "materials/material.hpp"
#include "support/random.hpp"

namespace fsi::test {

namespace {

const double alpha = 29 * std::acos(-1.0) / 180;

Fibres fibres() {
  Fibres f;
  f.direction[0] = {{Pack(0.0), Pack(std::cos(alpha)), Pack(std::sin(alpha))}};
  f.direction[1] = {{Pack(0.0), Pack(std::cos(alpha)), Pack(-std::sin(alpha))}};
  return f;
}

/// A law of the list with another number for each parameter that it allows: of sets of which one is given, the last.
Material example(const MaterialKind& kind) {
  ParameterValues values;
  double value = 0.11;
  const auto give = [&](const Parameter& parameter) {
    value += 0.06;
    values[parameter.name] = value < parameter.bounds.high ? value : 0.6 * parameter.bounds.high;
  };
  for (const auto& parameter : kind.parameters)
    if (!parameter.of_a_set) give(parameter);
  if (!kind.sets.empty())
    for (const auto& name : kind.sets.back()) give(*kind.find(name));
  return kind.make(values);
}

/// S' of the nearly incompressible forms, P' of the others, and the energy.
template <class Form>
std::vector<double> answers(const Form& form, const Mat3<Pack>& h) {
  Mat3<Pack> flux;
  Pack energy;
  if constexpr (std::is_same_v<Form, CompressibleLaw>) {
    flux = form.response(h, deformation(h)).flux;
    energy = form.energy(h);
  } else if constexpr (std::is_same_v<typename Form::FibreData, Fibres>) {
    flux = deformation(h).gradient * form.stress(strain_of(h), fibres());
    energy = form.energy(strain_of(h), fibres());
  } else {
    flux = deformation(h).gradient * form.stress(strain_of(h), {});
    energy = form.energy(strain_of(h), {});
  }
  std::vector<double> all{energy[0]};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) all.push_back(flux(i, j)[0]);
  return all;
}

PointConstants everywhere(const LawConstants<double>& constants) {
  PointConstants at;
  for (int lane = 0; lane < pack_width; ++lane) at.set(lane, constants);
  at.fibres = fibres();
  return at;
}

std::vector<double> answers(const VaryingLaw& law, const PointConstants& at, const Mat3<Pack>& h) {
  std::vector<double> all{law.energy(h, at)[0]};
  const auto flux = law.response(h, deformation(h), at).flux;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) all.push_back(flux(i, j)[0]);
  return all;
}

Mat3<Pack> stretched() {
  Random random(7);
  Mat3<Pack> h;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) h(i, j) = Pack(0.05 * random() + (i == j ? (i == 0 ? -0.15 : 0.25) : 0));
  return h;
}

TEST(VaryingLaw, IsEachLawOfTheListWithItsConstants) {
  const auto h = stretched();
  std::size_t laws = 0;
  for (const auto& [name, kind] : materials().rows()) {
    SCOPED_TRACE(name);
    ++laws;
    const Material material = example(kind);
    for (const bool varies : {false, true}) {
      const VaryingLaw law(material, varies);
      const LawConstants<double> constants = law_constants(material, 50);
      const auto found = answers(law, everywhere(constants), h);
      const auto expected = std::visit(
          [&](const auto& of_list) {
            return std::visit([&](const auto& form) { return answers(form, h); },
                              FormsOf<std::decay_t<decltype(of_list)>>::of(of_list, varies));
          },
          material);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_NEAR(found[i], expected[i], 1e-14 * (1 + std::abs(expected[i])));
      EXPECT_EQ(constants.shear_modulus, shear_modulus(material));
      EXPECT_EQ(constants.bulk_modulus, bulk_modulus(material, 50));
      EXPECT_EQ(law.is_compressible(), std::holds_alternative<CompressibleLaw>(element_law(material)));
      EXPECT_EQ(law.on_reference(), std::holds_alternative<LinearElastic>(material));
    }
  }
  EXPECT_EQ(laws, std::variant_size_v<Material>);
}

// None is dropped on the way to the element loops.
TEST(VaryingLaw, HearsOfEachConstant) {
  const auto h = stretched();
  for (const auto& [name, kind] : materials().rows()) {
    const Material material = example(kind);
    const VaryingLaw law(material, true);
    const LawConstants<double> constants = law_constants(material, 50);
    const double energy = law.energy(h, everywhere(constants))[0];
    for (std::size_t i = 0; i < constants.of_law.size(); ++i) {
      if (constants.of_law[i] == 0) continue;  // room of laws with more
      LawConstants<double> other = constants;
      other.of_law[i] *= 1.1;
      EXPECT_GT(std::abs(law.energy(h, everywhere(other))[0] - energy), 1e-6 * energy) << name << ", constant " << i;
    }
  }
}

TEST(VaryingLaw, StandsForLawsWithoutLoopsOfTheirOwn) {
  EXPECT_TRUE(std::holds_alternative<VaryingLaw>(element_law(Yeoh{3, 1, 1})));
  EXPECT_TRUE(std::holds_alternative<VaryingLaw>(element_law(HolzapfelGasserOgden{3, 1, 1, 1, 1})));
  EXPECT_TRUE(std::holds_alternative<MooneyRivlin>(element_law(MooneyRivlin{3, 1})));
}

TEST(VaryingLaw, DispersionDecidesTheArterysForm) {
  const Artery parallel{3, 2, 1, 1, 29};
  EXPECT_TRUE(decides_form(parallel, "kappa"));
  EXPECT_FALSE(decides_form(parallel, "k1"));
  EXPECT_FALSE(decides_form(NeoHookean{3}, "c10"));
  // Of fibres that are slack the two forms are the same; here one family is stretched.
  const auto h = stretched();
  LawConstants<double> constants = law_constants(parallel, 50);
  constants.of_law[4] = 0.2;
  const double of_parallel = VaryingLaw(parallel, false).energy(h, everywhere(constants))[0];
  const double of_dispersed = VaryingLaw(parallel, true).energy(h, everywhere(constants))[0];
  EXPECT_EQ(of_parallel, VaryingLaw(parallel, false).energy(h, everywhere(law_constants(parallel, 50)))[0]);
  EXPECT_GT(std::abs(of_dispersed - of_parallel), 1e-3);
}

}  // namespace

}  // namespace fsi::test
