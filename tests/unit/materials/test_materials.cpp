#include <gtest/gtest.h>

#include <cmath>

#include "materials/material.hpp"
#include "support/differences.hpp"
#include "support/random.hpp"

namespace fsi::test {

namespace {

// Material constants of docs/theory.md, section 1.3 (media).
const NeoHookean neo_hookean{3.0};
const MooneyRivlin mooney_rivlin{3.0, 0.3};
const Artery artery{3.0, 2.3632, 0.8393};
const Yeoh yeoh{3.0, 0.7, 0.2};
const HolzapfelGasserOgden two_families{3.0, 2.3632, 0.8393, 0.9, 1.7, 0.2};

/// All of these tests look at lane 0 alone: every lane holds the same.
template <class T>
Sym3<T> sym3(const double (&c)[6]) {
  Sym3<T> s;
  for (int k = 0; k < 6; ++k) s.c[k] = T(c[k]);
  return s;
}

/// The strain measures of a given C, not of an F: for derivatives with respect to C.
template <class T>
Strain<T> strain_from(const Sym3<T>& c) {
  Sym3<T> change = c;
  for (int k = 0; k < 3; ++k) change.c[k] -= Pack(1.0);
  const Sym3<T> cof = cofactor(change);
  const T third = change(0, 0) * cof(0, 0) + change(0, 1) * cof(0, 1) + change(0, 2) * cof(0, 2);
  return fsi::strain_from(change, trace(change) + trace(cof) + third);
}

Fibres fibres_at(double angle) {
  Fibres f;
  f.direction[0] = {{Pack(0.0), Pack(std::cos(angle)), Pack(std::sin(angle))}};
  f.direction[1] = {{Pack(0.0), Pack(std::cos(angle)), Pack(-std::sin(angle))}};
  return f;
}
const Fibres fibres = fibres_at(29 * 3.14159265358979323846 / 180);

template <class M>
auto fibre_data(const M&) {
  if constexpr (std::is_same_v<typename M::FibreData, Fibres>)
    return fibres;
  else
    return NoFibres{};
}

std::vector<double> values(const Sym3<Pack>& s) {
  std::vector<double> v(6);
  for (int k = 0; k < 6; ++k) v[k] = s.c[k][0];
  return v;
}

/// F as a displacement gradient around the given principal stretches.
Mat3<Pack> random_gradient(const double (&stretch)[3], double amount, unsigned seed) {
  Random random(seed);
  Mat3<Pack> h;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) h(i, j) = Pack(amount * random() + (i == j ? stretch[i] - 1 : 0));
  return h;
}

Mat3<Pack> rotation(double a, double b) {
  const auto matrix = [](const double(&m)[3][3]) {
    Mat3<Pack> r;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) r(i, j) = Pack(m[i][j]);
    return r;
  };
  return matrix({{std::cos(a), -std::sin(a), 0}, {std::sin(a), std::cos(a), 0}, {0, 0, 1}}) *
         matrix({{1, 0, 0}, {0, std::cos(b), -std::sin(b)}, {0, std::sin(b), std::cos(b)}});
}

Mat3<Pack> identity_matrix() {
  Mat3<Pack> i;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) i(r, c) = Pack(r == c ? 1.0 : 0.0);
  return i;
}

/// S : dC/2 with dC given by its six components.
double power(const std::vector<double>& s, const double (&dc)[6]) {
  return 0.5 * (s[0] * dc[0] + s[1] * dc[1] + s[2] * dc[2]) + s[3] * dc[3] + s[4] * dc[4] + s[5] * dc[5];
}

template <class M>
void expect_stress_and_tangent(const M& material, const Sym3<Pack>& c0, const std::string& name) {
  const auto data = fibre_data(material);
  const auto c = values(c0);
  const auto at = [&](const double(&dc)[6], double t) {
    double there[6];
    for (int k = 0; k < 6; ++k) there[k] = c[k] + t * dc[k];
    return strain_from(sym3<Pack>(there));
  };
  const auto stress = values(material.stress(at({}, 0), data));

  // The tangent by dual numbers, one seed per component of C.
  Sym3<Dual<6>> seeded;
  for (int k = 0; k < 6; ++k) {
    seeded.c[k] = Dual<6>(c0.c[k]);
    seeded.c[k].slope[k] = Pack(1.0);
  }
  const auto dual_stress = material.stress(strain_from(seeded), data);
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(dual_stress.c[k].value[0], stress[k], 1e-13) << name;

  Random random(5);
  for (int direction = 0; direction < 3; ++direction) {
    double dc[6];
    for (double& component : dc) component = 0.2 * random();
    expect_second_order(central_differences(
        name + ": S = 2 dPsi/dC", [&](double t) { return std::vector<double>{material.energy(at(dc, t), data)[0]}; },
        {power(stress, dc)}));
    std::vector<double> tangent(6, 0.0);
    for (int k = 0; k < 6; ++k)
      for (int m = 0; m < 6; ++m) tangent[k] += dual_stress.c[k].slope[m][0] * dc[m];
    expect_second_order(central_differences(
        name + ": tangent = dS/dC", [&](double t) { return values(material.stress(at(dc, t), data)); }, tangent));
  }
}

/// C of a random deformation about principal stretches (radial, circumferential, axial).
Sym3<Pack> random_strain(const double (&stretches)[3], unsigned seed) {
  return strain_of(random_gradient(stretches, 0.08, seed)).change + identity<Pack>();
}

TEST(NeoHookean, StressAndTangentAreDerivativesOfTheEnergy) {
  expect_stress_and_tangent(neo_hookean, random_strain({0.9, 1.3, 1.1}, 1), "neo-Hookean");
}

TEST(MooneyRivlin, StressAndTangentAreDerivativesOfTheEnergy) {
  expect_stress_and_tangent(mooney_rivlin, random_strain({0.9, 1.3, 1.1}, 2), "Mooney-Rivlin");
}

TEST(Yeoh, StressAndTangentAreDerivativesOfTheEnergy) {
  expect_stress_and_tangent(yeoh, random_strain({0.9, 1.3, 1.1}, 2), "Yeoh");
}

TEST(HolzapfelGasserOgden, StressAndTangentAreDerivativesOfTheEnergyInExtensionAndCompression) {
  expect_stress_and_tangent(two_families, random_strain({0.8, 1.3, 1.1}, 3), "both families stretched");
  expect_stress_and_tangent(two_families, random_strain({1.4, 0.8, 0.85}, 4), "both families compressed");
}

TEST(Artery, StressAndTangentAreDerivativesOfTheEnergyOnBothSidesOfSlackFibres) {
  const auto stretches = [](const Sym3<Pack>& c) {
    const auto s = strain_from(c);
    return std::array{1 + extension(s, fibres.direction[0])[0], 1 + extension(s, fibres.direction[1])[0]};
  };
  const auto both = random_strain({0.8, 1.3, 1.1}, 3);
  EXPECT_GT(std::min(stretches(both)[0], stretches(both)[1]), 1.1);
  expect_stress_and_tangent(artery, both, "artery, fibres stretched");

  const auto none = random_strain({1.4, 0.8, 0.85}, 4);
  EXPECT_LT(std::max(stretches(none)[0], stretches(none)[1]), 0.9);
  expect_stress_and_tangent(artery, none, "artery, fibres slack");

  auto one = random_strain({1, 1, 1}, 5);
  one(1, 2) = Pack(0.3);  // shear in the plane of the fibres stretches one family and slackens the other
  EXPECT_GT(stretches(one)[0], 1.1);
  EXPECT_LT(stretches(one)[1], 0.9);
  expect_stress_and_tangent(artery, one, "artery, one family stretched");
}

// At J_i = 1 the fibre stress is continuous and its derivative along dC jumps by 2 k1 dev(a a^T) (dev(a a^T) : dC) per
// family when C = I, from S' = 2 k1 (J_i - 1) dev(a a^T) + higher terms and dJ_i = dev(a a^T) : dC.
TEST(Artery, TangentJumpsByTheClosedFormWhereAFibreTightens) {
  const double stretching[6] = {-0.3, 0.5, -0.2, 0.05, 0.0, -0.1};  // tightens both families
  const auto at = [&](double t) {
    double c[6];
    for (int k = 0; k < 6; ++k) c[k] = (k < 3 ? 1.0 : 0.0) + t * stretching[k];
    return values(artery.stress(strain_from(sym3<Pack>(c)), fibres));
  };
  std::vector<double> jump(6, 0.0);
  for (const auto& a : fibres.direction) {
    double dev[6], rate = 0;
    const auto aa = dyad(a);
    for (int k = 0; k < 6; ++k) {
      dev[k] = aa.c[k][0] - (k < 3 ? 1.0 / 3 : 0.0);
      rate += dev[k] * stretching[k] * (k < 3 ? 1 : 2);
    }
    EXPECT_GT(rate, 0.1);
    for (int k = 0; k < 6; ++k) jump[k] += 2 * artery.k1 * dev[k] * rate;
  }
  EXPECT_GT(norm(jump), 1);
  for (double t : {1e-3, 1e-4, 1e-5}) {
    EXPECT_LT(norm(difference(at(t), at(-t))), 10 * t) << "the stress is continuous";
    // One-sided slopes; their difference tends to the jump with an error of first order in t.
    std::vector<double> seen(6);
    for (int k = 0; k < 6; ++k) seen[k] = (at(t)[k] - at(0)[k]) / t - (at(0)[k] - at(-t)[k]) / t;
    EXPECT_LT(norm(difference(seen, jump)), 10 * t * norm(jump));
  }
}

template <class M>
class EveryMaterial : public testing::Test {
 public:
  static M material() {
    if constexpr (std::is_same_v<M, NeoHookean>) return neo_hookean;
    if constexpr (std::is_same_v<M, MooneyRivlin>) return mooney_rivlin;
    if constexpr (std::is_same_v<M, Artery>) return artery;
    if constexpr (std::is_same_v<M, Yeoh>) return yeoh;
    if constexpr (std::is_same_v<M, HolzapfelGasserOgden>) return two_families;
  }
};
using Materials = testing::Types<NeoHookean, MooneyRivlin, Artery, Yeoh, HolzapfelGasserOgden>;
TYPED_TEST_SUITE(EveryMaterial, Materials);

TYPED_TEST(EveryMaterial, HasNoIsochoricStressAtRestNorUnderPureVolumeChange) {
  const auto material = this->material();
  for (double stretch : {1.0, 0.9, 1.2}) {
    const double c = stretch * stretch;
    const auto strain = strain_from(sym3<Pack>({c, c, c, 0, 0, 0}));
    EXPECT_LT(largest(values(material.stress(strain, fibre_data(material)))), 1e-14);
    EXPECT_NEAR(material.energy(strain, fibre_data(material))[0], 0, 1e-14);
  }
}

TYPED_TEST(EveryMaterial, StressIsDeviatoricInTheCurrentFrame) {
  const auto material = this->material();
  const auto c = random_strain({0.8, 1.3, 1.1}, 6);
  const auto s = material.stress(strain_from(c), fibre_data(material));
  EXPECT_GT(largest(values(s)), 0.1);
  EXPECT_NEAR(contract(s, c)[0], 0, 1e-13);  // S' : C = J tr(sigma')
}

TYPED_TEST(EveryMaterial, StressAndEnergyIgnoreRotations) {
  const auto material = this->material();
  const auto h = random_gradient({0.8, 1.3, 1.1}, 0.1, 7);
  const auto rotated = rotation(0.7, -1.9) * (identity_matrix() + h) - identity_matrix();
  const auto strain = strain_of(h), rotated_strain = strain_of(rotated);
  const auto data = fibre_data(material);
  EXPECT_LT(largest(difference(values(material.stress(strain, data)), values(material.stress(rotated_strain, data)))),
            1e-13);
  EXPECT_NEAR(material.energy(strain, data)[0], material.energy(rotated_strain, data)[0], 1e-13);
}

// Linear elasticity: S' = 2 mu dev(E) for small strains E; mu = c10 + c01 by hand from the energies, without fibres.
TYPED_TEST(EveryMaterial, ShearModulusIsTheSlopeOfTheStressAtRest) {
  auto material = this->material();
  if constexpr (std::is_same_v<TypeParam, HolzapfelGasserOgden>) material.k1 = material.k1_second = 0;  // never slack
  const double t = 1e-6;
  // Slack fibres: compression in the plane that the fibres lie in.
  const auto s =
      values(material.stress(strain_from(sym3<Pack>({1 + 2 * t, 1 - t, 1 - t, 0.5 * t, 0, 0})), fibre_data(material)));
  const double mu = std::is_same_v<TypeParam, MooneyRivlin> ? 3.3 : 3.0;
  EXPECT_DOUBLE_EQ(material.shear_modulus(), mu);
  const double expected[6] = {2 * mu * t, -mu * t, -mu * t, 0.5 * mu * t, 0, 0};
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(s[k], expected[k], 1e-4 * mu * t);
}

TEST(Artery, FibreScaleScalesFibreStressAndEnergyAndNothingElse) {
  const auto strain = strain_from(random_strain({0.8, 1.3, 1.1}, 8));
  Artery half = artery, without = artery;
  half.fibre_scale = 0.5;
  without.fibre_scale = 0;
  const auto s = values(artery.stress(strain, fibres)), s_half = values(half.stress(strain, fibres)),
             s_without = values(without.stress(strain, fibres)), ground = values(neo_hookean.stress(strain, {}));
  for (int k = 0; k < 6; ++k) {
    EXPECT_NEAR(s_half[k], 0.5 * (s[k] + s_without[k]), 1e-13);
    EXPECT_NEAR(s_without[k], ground[k], 1e-13);
  }
  EXPECT_GT(norm(difference(s, ground)), 0.5);
  EXPECT_NEAR(half.energy(strain, fibres)[0],
              0.5 * (artery.energy(strain, fibres)[0] + neo_hookean.energy(strain, {})[0]), 1e-13);
}

TEST(Artery, IsNeoHookeanWhileItsFibresAreSlack) {
  const auto strain = strain_from(random_strain({1.4, 0.8, 0.85}, 9));
  EXPECT_LT(largest(difference(values(artery.stress(strain, fibres)), values(neo_hookean.stress(strain, {})))), 1e-14);
}

// A pack holds elements on both sides of J_i = 1: each lane must follow its own branch.
TEST(Artery, LanesOfAPackAreIndependent) {
  Sym3<Pack> mixed = random_strain({0.8, 1.3, 1.1}, 10);
  const Sym3<Pack> slack = random_strain({1.4, 0.8, 0.85}, 11), stretched = mixed;
  for (int k = 0; k < 6; ++k) mixed.c[k].set(1, slack.c[k][1]);
  const auto s = artery.stress(strain_from(mixed), fibres), s0 = artery.stress(strain_from(stretched), fibres),
             s1 = artery.stress(strain_from(slack), fibres);
  for (int k = 0; k < 6; ++k) {
    EXPECT_EQ(s.c[k][0], s0.c[k][0]);
    EXPECT_EQ(s.c[k][1], s1.c[k][1]);
  }
}

// Uniaxial isochoric stretch of a neo-Hookean: W = c10/2 (l^2 + 2/l - 3), Cauchy stress difference c10 (l^2 - 1/l), by
// hand.
TEST(NeoHookean, UniaxialStretchByHand) {
  const double l = 1.3;
  const auto strain = strain_from(sym3<Pack>({l * l, 1 / l, 1 / l, 0, 0, 0}));
  EXPECT_NEAR(neo_hookean.energy(strain, {})[0], 1.5 * (l * l + 2 / l - 3), 1e-14);
  const auto s = values(neo_hookean.stress(strain, {}));
  EXPECT_NEAR(s[0] * l * l - s[1] / l, 3 * (l * l - 1 / l), 1e-13);
}

// The same for Mooney-Rivlin: W = c10/2 (l^2 + 2/l - 3) + c01/2 (2 l + 1/l^2 - 3), difference
// c10 (l^2 - 1/l) + c01 (l - 1/l^2), by hand.
TEST(MooneyRivlin, UniaxialStretchByHand) {
  const double l = 1.3;
  const auto strain = strain_from(sym3<Pack>({l * l, 1 / l, 1 / l, 0, 0, 0}));
  EXPECT_NEAR(mooney_rivlin.energy(strain, {})[0], 1.5 * (l * l + 2 / l - 3) + 0.15 * (2 * l + 1 / (l * l) - 3), 1e-14);
  const auto s = values(mooney_rivlin.stress(strain, {}));
  EXPECT_NEAR(s[0] * l * l - s[1] / l, 3 * (l * l - 1 / l) + 0.3 * (l - 1 / (l * l)), 1e-13);
}

// The energy with k2 -> 0 is k1/2 sum (J_i - 1)^2, its stress 2 k1 sum (J_i - 1) dJ_i/dC; the reference is computed in
// long double, by the series of exp where (exp(x) - 1) / x would cancel.
// An incompressible bar of stretch l: W(l), and sigma = l dW/dl, by hand. x = J_1 - 3 = l^2 + 2/l - 3.
TEST(Yeoh, UniaxialStretchByHand) {
  const double l = 1.3, x = l * l + 2 / l - 3, slope = 2 * l - 2 / (l * l);
  const auto strain = strain_from(sym3<Pack>({1 / l, l * l, 1 / l, 0, 0, 0}));
  EXPECT_NEAR(yeoh.energy(strain, {})[0], 1.5 * x + 0.7 * x * x + 0.2 * x * x * x, 1e-14);
  const auto s = values(yeoh.stress(strain, {}));
  EXPECT_NEAR(s[1] * l * l - s[0] / l, l * slope * (1.5 + 1.4 * x + 0.6 * x * x), 1e-13);
}

// Fibres along the circumference alone, so that J_4 = l^2 for both families: in extension and in compression
//   W = c10/2 x + sum of k1_i/(2 k2_i) (exp(k2_i E^2) - 1),  E = kappa x + (1 - 3 kappa) (l^2 - 1).
TEST(HolzapfelGasserOgden, UniaxialStretchByHand) {
  const auto& law = two_families;
  for (double l : {1.3, 0.8}) {
    const double x = l * l + 2 / l - 3, slope = 2 * l - 2 / (l * l);
    const double e = law.kappa * x + (1 - 3 * law.kappa) * (l * l - 1);
    const double e_slope = law.kappa * slope + (1 - 3 * law.kappa) * 2 * l;
    double w = law.c10 / 2 * x, w_slope = law.c10 / 2 * slope;
    for (const auto& [k1, k2] : {std::pair{law.k1, law.k2}, std::pair{law.k1_second, law.k2_second}}) {
      w += k1 / (2 * k2) * std::expm1(k2 * e * e);
      w_slope += k1 * e * std::exp(k2 * e * e) * e_slope;
    }
    const auto strain = strain_from(sym3<Pack>({1 / l, l * l, 1 / l, 0, 0, 0}));
    EXPECT_NEAR(law.energy(strain, fibres_at(0))[0], w, 1e-13);
    const auto s = values(law.stress(strain, fibres_at(0)));
    EXPECT_NEAR(s[1] * l * l - s[0] / l, l * w_slope, 1e-12);
  }
}

TEST(HolzapfelGasserOgden, IsTheArteryWhereItsFibresAreStretched) {
  const HolzapfelGasserOgden alike{3.0, 2.3632, 0.8393, 2.3632, 0.8393};
  const auto stretched = strain_from(random_strain({0.8, 1.3, 1.1}, 3)),
             slack = strain_from(random_strain({1.4, 0.8, 0.85}, 4));
  const auto apart = [&](const Strain<Pack>& s) {
    return norm(difference(values(alike.stress(s, fibres)), values(artery.stress(s, fibres))));
  };
  EXPECT_LT(apart(stretched), 1e-13);
  EXPECT_GT(apart(slack), 0.5) << "these fibres bear compression";
}

TEST(Artery, EnergyAndStressAreAccurateForEveryExponent) {
  const auto phi_of = [](long double x) {
    if (x > 1) return (std::exp(x) - 1) / x;
    long double sum = 1, term = 1;
    for (int k = 2; k < 40; ++k) sum += term *= x / k;
    return sum;
  };
  for (double size : {1e-9, 1e-4, 0.1}) {
    const auto strain = strain_of(random_gradient({1 - 2 * size, 1 + 3 * size, 1 + size}, 0.1 * size, 12));
    for (double k2 : {5e-324, 1e-300, 1e-20, 1e-12, 1e-6, 1e-3, 0.8393, 10.0, 300.0}) {
      Artery law = artery, none = artery;
      law.k2 = k2;
      none.k1 = 0;
      long double energy = 0;
      for (const auto& a : fibres.direction) {
        const long double stretch = extension(strain, a)[0], x = k2 * stretch * stretch;
        ASSERT_GT(stretch, 0);
        energy += 0.5L * law.k1 * stretch * stretch * phi_of(x);
      }
      const double found = law.energy(strain, fibres)[0], ground = none.energy(strain, fibres)[0];
      const double expected = static_cast<double>(energy) + ground;
      EXPECT_NEAR(found, expected, 4e-15 * expected) << "k2 = " << k2 << ", strain " << size;
      // The radial component of dev(a a^T) is -C^-1/3 alone, the fibres lying in the tangential plane.
      const double fibre_part = law.stress(strain, fibres).c[0][0] - none.stress(strain, fibres).c[0][0];
      long double by_hand = 0;
      for (const auto& a : fibres.direction) {
        const long double stretch = extension(strain, a)[0];
        by_hand -= 2 * law.k1 * std::exp(k2 * stretch * stretch) * stretch * (1 + stretch) / 3 *
                   (1 - static_cast<long double>(strain.inverse_change.c[0][0]));
      }
      EXPECT_NEAR(fibre_part, static_cast<double>(by_hand), 1e-14 * std::abs(static_cast<double>(by_hand)));
    }
  }
}

TEST(Artery, AnExponentTooLargeIsNotFinite) {  // and so refused by Newton's method, never a number that is wrong
  Artery law = artery;
  law.k2 = 1e6;
  const auto strain = strain_of(random_gradient({0.8, 1.3, 1.1}, 0, 12));
  EXPECT_FALSE(std::isfinite(law.energy(strain, fibres)[0]));
  EXPECT_FALSE(std::isfinite(law.stress(strain, fibres).c[0][0]));
}

// Stress and energy of a strain that is t times as large are t and t^2 times as large, to first order in t: down to the
// smallest numbers, since no term is a difference of larger ones.
TYPED_TEST(EveryMaterial, IsLinearForVanishingStrains) {
  const auto material = this->material();
  const auto data = fibre_data(material);
  const auto scaled = [&](double t) {
    auto h = random_gradient({0.8, 1.3, 1.1}, 0.1, 13);
    h(0, 0) += -(h(0, 0) + h(1, 1) + h(2, 2));  // no change of volume to first order
    return strain_of(Pack(t) * h);
  };
  const double t0 = 1e-8;
  const auto s0 = values(material.stress(scaled(t0), data));
  const double psi0 = material.energy(scaled(t0), data)[0] / (t0 * t0);
  EXPECT_GT(psi0, 0.1);
  for (double t : {1e-12, 1e-20, 1e-60, 1e-140}) {
    const auto s = values(material.stress(scaled(t), data));
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(s[k] / t, s0[k] / t0, 1e-6 * largest(s0) / t0) << t;
    EXPECT_NEAR(material.energy(scaled(t), data)[0] / t / t, psi0, 1e-6 * psi0) << t;
  }
}

}  // namespace

}  // namespace fsi::test
