// The laws with a finite bulk modulus in the mixed form: the stress P' - p G with p = -K g against the derivative of
// the energy Psi' + K/2 g^2, against the laws' textbook stresses, and against closed forms.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/error.hpp"
#include "materials/material.hpp"
#include "materials/varying_law.hpp"
#include "support/differences.hpp"
#include "support/random.hpp"

namespace fsi::test {

namespace {

constexpr double young = 10, poisson = 0.3;
constexpr double mu = young / 2.6, lambda = young * poisson / (1.3 * 0.4), bulk = young / 1.2;

struct NamedLaw {
  const char* name;
  Material material;
  CompressibleLaw law = std::get<CompressibleLaw>(element_law(material));
};
SaintVenantKirchhoff with_young() {
  SaintVenantKirchhoff law;
  law.young = young;
  law.poisson = poisson;
  return law;
}
const std::array<NamedLaw, 3>& laws() {
  static const std::array<NamedLaw, 3> all = [] {
    const ParameterValues constants{{"young", young}, {"poisson", poisson}};
    const auto named = [&](const char* name) { return NamedLaw{name, make_material(name, constants)}; };
    return std::array<NamedLaw, 3>{named("saint-venant-kirchhoff"), named("linear-elastic"),
                                   named("compressible-neo-hookean")};
  }();
  return all;
}
const NamedLaw &svk = laws()[0], &linear = laws()[1], &neo_hookean = laws()[2];

using Matrix = std::array<std::array<double, 3>, 3>;

Mat3<Pack> packed(const Matrix& m) {
  Mat3<Pack> h;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) h(i, j) = Pack(m[i][j]);
  return h;
}
Matrix moved_by(const Matrix& h, double t, const Matrix& direction) {
  Matrix sum = h;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) sum[i][j] += t * direction[i][j];
  return sum;
}
Matrix random_matrix(double size, unsigned seed) {
  Random random(seed);
  Matrix m;
  for (auto& row : m)
    for (double& x : row) x = size * random();
  return m;
}
Matrix diagonal(double a, double b, double c) {
  return {{{a, 0, 0}, {0, b, 0}, {0, 0, c}}};
}

/// P of grad d when the pressure is what its equation makes of it.
template <class T>
Mat3<T> stress(const CompressibleLaw& law, const Mat3<T>& h) {
  const Response<T> r = law.response(h, deformation(h));
  return r.flux + (Pack(bulk) * r.volume_measure) * r.volume_gradient;
}
double energy(const CompressibleLaw& law, const Matrix& m) {
  const Mat3<Pack> h = packed(m);
  const double g = law.response(h, deformation(h)).volume_measure[0];
  return law.energy(h)[0] + bulk / 2 * g * g;
}
std::vector<double> stress(const CompressibleLaw& law, const Matrix& m) {
  const Mat3<Pack> p = stress(law, packed(m));
  std::vector<double> values;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) values.push_back(p(i, j)[0]);
  return values;
}

const Matrix deformed = moved_by(diagonal(-0.15, 0.3, 0.1), 1, random_matrix(0.15, 1));

TEST(CompressibleLaws, StressIsTheDerivativeOfTheEnergyAndTheTangentOfTheStress) {
  for (const auto& [name, material, law] : laws()) {
    const auto p = stress(law, deformed);
    Mat3<Dual<9>> seeded;
    for (int k = 0; k < 9; ++k) {
      seeded(k / 3, k % 3) = Dual<9>(deformed[k / 3][k % 3]);
      seeded(k / 3, k % 3).slope[k] = Pack(1.0);
    }
    const auto tangent = stress(law, seeded);
    for (unsigned seed = 2; seed < 5; ++seed) {
      const Matrix direction = random_matrix(0.5, seed);
      double power = 0;
      std::vector<double> slope(9, 0.0);
      for (int k = 0; k < 9; ++k) {
        power += p[k] * direction[k / 3][k % 3];
        for (int m = 0; m < 9; ++m) slope[k] += tangent(k / 3, k % 3).slope[m][0] * direction[m / 3][m % 3];
      }
      const auto energy_at = [&, of = law](double t) {
        return std::vector<double>{energy(of, moved_by(deformed, t, direction))};
      };
      const auto stress_at = [&, of = law](double t) { return stress(of, moved_by(deformed, t, direction)); };
      if (law.is<LinearElastic>()) {  // differences of a quadratic energy are exact
        EXPECT_NEAR((energy_at(0.1)[0] - energy_at(-0.1)[0]) / 0.2, power, 1e-12 * std::abs(power));
        for (int k = 0; k < 9; ++k) EXPECT_NEAR((stress_at(0.1)[k] - stress_at(-0.1)[k]) / 0.2, slope[k], 1e-12);
      } else {
        expect_second_order(central_differences(std::string(name) + ": P = dPsi/dF", energy_at, {power}));
        expect_second_order(central_differences(std::string(name) + ": dP/dF", stress_at, slope));
      }
    }
  }
}

// Of any F, written as textbooks do: S = lambda tr E I + 2 mu E; sigma = lambda tr eps I + 2 mu eps;
// P = mu (F - F^-T) + lambda ln J F^-T.
TEST(CompressibleLaws, StressIsThatOfTheTextbook) {
  double f[3][3], e[3][3], cof[3][3], trace_e = 0, trace_h = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) f[i][j] = deformed[i][j] + (i == j);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      e[i][j] = (f[0][i] * f[0][j] + f[1][i] * f[1][j] + f[2][i] * f[2][j] - (i == j)) / 2;
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      cof[i][j] = f[i1][j1] * f[i2][j2] - f[i1][j2] * f[i2][j1];
    }
    trace_e += e[i][i];
    trace_h += deformed[i][i];
  }
  const double ratio = f[0][0] * cof[0][0] + f[0][1] * cof[0][1] + f[0][2] * cof[0][2];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double of_svk = 0;
      for (int k = 0; k < 3; ++k) of_svk += f[i][k] * (lambda * trace_e * (k == j) + 2 * mu * e[k][j]);
      const double of_linear = lambda * trace_h * (i == j) + mu * (deformed[i][j] + deformed[j][i]);
      const double of_neo_hookean = mu * f[i][j] + (lambda * std::log(ratio) - mu) * cof[i][j] / ratio;
      EXPECT_NEAR(stress(svk.law, deformed)[3 * i + j], of_svk, 1e-13);
      EXPECT_NEAR(stress(linear.law, deformed)[3 * i + j], of_linear, 1e-13);
      EXPECT_NEAR(stress(neo_hookean.law, deformed)[3 * i + j], of_neo_hookean, 1e-13);
    }
}

// Pulled to a stretch l with free sides, by hand. Saint Venant-Kirchhoff: E_t = -nu E_l and P = E l (l^2 - 1)/2.
// Linear: P = E (l - 1). Neo-Hookean: mu (m^2 - 1) + lambda ln(l m^2) = 0 for the sides' stretch m, and
// P = mu (l^2 - m^2)/l.
TEST(CompressibleLaws, UniaxialTension) {
  const double l = 1.2;
  const double side = std::sqrt(1 - poisson * (l * l - 1)) - 1;
  const auto of_svk = stress(svk.law, diagonal(l - 1, side, side));
  EXPECT_NEAR(of_svk[0], 2.64, 1e-13);
  EXPECT_NEAR(of_svk[4], 0, 1e-13);

  const auto of_linear = stress(linear.law, diagonal(l - 1, -poisson * (l - 1), -poisson * (l - 1)));
  EXPECT_NEAR(of_linear[0], 2, 1e-13);
  EXPECT_NEAR(of_linear[4], 0, 1e-13);

  double low = 0.5, high = 1;
  for (int bisection = 0; bisection < 60; ++bisection) {
    const double m = (low + high) / 2;
    (mu * (m * m - 1) + lambda * std::log(l * m * m) > 0 ? high : low) = m;
  }
  const auto of_neo_hookean = stress(neo_hookean.law, diagonal(l - 1, low - 1, low - 1));
  EXPECT_NEAR(of_neo_hookean[0], mu * (l * l - low * low) / l, 1e-13);
  EXPECT_NEAR(of_neo_hookean[4], 0, 1e-13);
}

// x = X + gamma Y. Saint Venant-Kirchhoff: S = (lambda, lambda + 2 mu, lambda) gamma^2/2, S_xy = mu gamma. Linear:
// sigma_xy = mu gamma alone. Neo-Hookean: J = 1, sigma_xx = mu gamma^2, sigma_xy = mu gamma, nothing else.
TEST(CompressibleLaws, SimpleShear) {
  const double shear = 0.6;
  const Matrix h{{{0, shear, 0}, {0, 0, 0}, {0, 0, 0}}};
  const double square = shear * shear / 2;
  const double s_xx = lambda * square, s_yy = (lambda + 2 * mu) * square, s_xy = mu * shear;
  const double of_svk[9] = {s_xx + shear * s_xy, s_xy + shear * s_yy, 0, s_xy, s_yy, 0, 0, 0, lambda * square};
  const double of_linear[9] = {0, mu * shear, 0, mu * shear, 0, 0, 0, 0, 0};
  const double of_neo_hookean[9] = {0, mu * shear, 0, mu * shear, 0, 0, 0, 0, 0};  // P = sigma F^-T
  for (int k = 0; k < 9; ++k) {
    EXPECT_NEAR(stress(svk.law, h)[k], of_svk[k], 1e-13) << k;
    EXPECT_NEAR(stress(linear.law, h)[k], of_linear[k], 1e-13) << k;
    EXPECT_NEAR(stress(neo_hookean.law, h)[k], of_neo_hookean[k], 1e-13) << k;
  }
}

TEST(CompressibleLaws, AreLinearElasticityForVanishingStrains) {
  const Matrix direction = random_matrix(1, 7);
  const auto expected = stress(linear.law, direction);
  const double expected_energy = energy(linear.law, direction);
  for (const auto& [name, material, law] : laws())
    for (double t : {1e-9, 1e-20, 1e-60, 1e-140}) {
      const Matrix h = moved_by({}, t, direction);
      const auto found = stress(law, h);
      for (int k = 0; k < 9; ++k) EXPECT_NEAR(found[k] / t, expected[k], 1e-7 * largest(expected)) << name << " " << t;
      EXPECT_NEAR(energy(law, h) / t / t, expected_energy, 1e-7 * expected_energy) << name << " " << t;
    }
}

// A linear law has no volume that could be turned inside out.
TEST(CompressibleLaws, KnowTheConfigurationInWhichForcesBalance) {
  const Mat3<Pack> h = packed(diagonal(-1.5, 0.2, 0));
  EXPECT_LT(svk.law.response(h, deformation(h)).volume_ratio[0], 0);
  EXPECT_EQ(linear.law.response(h, deformation(h)).volume_ratio[0], 1);
}

TEST(CompressibleLaws, ConstantsOfEachKindMakeTheSameLaw) {
  for (const char* name : {"saint-venant-kirchhoff", "linear-elastic", "compressible-neo-hookean"}) {
    const auto by_young = make_material(name, {{"young", young}, {"poisson", poisson}});
    const auto by_lame = make_material(name, {{"lame_lambda", lambda}, {"lame_mu", mu}});
    for (const auto& material : {by_young, by_lame}) {
      EXPECT_NEAR(shear_modulus(material), mu, 1e-14);
      EXPECT_NEAR(bulk_modulus(material, 1e9), bulk, 1e-14);
      EXPECT_FALSE(needs_bulk_modulus(material));
      EXPECT_NEAR(hoop_modulus(material, 1e9), young / (1 - poisson * poisson), 1e-13);
      EXPECT_FALSE(has_fibres(material));
      EXPECT_EQ(fibre_stiffness(material), 0);
    }
  }
  const auto by_c10 = make_material("compressible-neo-hookean", {{"c10", mu}, {"bulk_modulus", bulk}});
  EXPECT_NEAR(hoop_modulus(by_c10, 1e9), young / (1 - poisson * poisson), 1e-13);
  EXPECT_EQ(inflation_modulus(by_c10), mu);
  EXPECT_EQ(inflation_modulus(laws()[0].material), std::nullopt);
  EXPECT_NEAR(*inflation_modulus(laws()[1].material), young / (1 - poisson * poisson), 1e-13);
  EXPECT_NEAR(with_young().plane_modulus(), young / (1 - poisson * poisson), 1e-13);

  const auto neo = make_material("neo-hookean", {{"young", 9}, {"poisson", 0.499}});
  EXPECT_NEAR(shear_modulus(neo), 9 / 2.998, 1e-14);
  EXPECT_NEAR(bulk_modulus(neo, 1), 9 / (3 * 0.002), 1e-9);
  EXPECT_TRUE(needs_bulk_modulus(make_material("neo-hookean", {{"c10", 3}})));
}

std::string complaint(const std::string& name, const ParameterValues& values) {
  try {
    make_material(name, values);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CompressibleLaws, TakeExactlyOneSetOfConstants) {
  const std::string sets = "give young and poisson, or lame_lambda and lame_mu";
  EXPECT_EQ(complaint("linear-elastic", {}), "parameters of linear-elastic: has too few constants; " + sets);
  EXPECT_EQ(complaint("linear-elastic", {{"young", 3}}),
            "parameters of linear-elastic: young alone is no set of its constants; " + sets);
  EXPECT_EQ(
      complaint("saint-venant-kirchhoff", {{"young", 3}, {"poisson", 0.3}, {"lame_mu", 3}}),
      "parameters of saint-venant-kirchhoff: young, poisson and lame_mu together are no set of its constants; " + sets);
  EXPECT_EQ(complaint("compressible-neo-hookean", {{"c10", 3}, {"lame_mu", 3}}),
            "parameters of compressible-neo-hookean: lame_mu and c10 together are no set of its constants; " + sets +
                ", or c10 and bulk_modulus");
  EXPECT_EQ(complaint("neo-hookean", {{"c10", 3}, {"young", 3}}),
            "parameters of neo-hookean: c10 and young together are no set of its constants; give c10, or young and "
            "poisson");
  EXPECT_EQ(complaint("linear-elastic", {{"lame_lambda", -2}, {"lame_mu", 3}}),
            "parameters of linear-elastic: lame_lambda + 2/3 lame_mu, the bulk modulus, is not positive; give a "
            "lame_lambda of more than -2/3 lame_mu");
  EXPECT_EQ(complaint("linear-elastic", {{"lame_lambda", -1.9}, {"lame_mu", 3}}), "");
}

TEST(CompressibleLaws, LogarithmsAreAccurateForEveryArgument) {
  for (double x : {-0.9, -0.31, -0.299, -0.1, -1e-3, -1e-9, 1e-160, 1e-12, 1e-5, 0.01, 0.299, 0.301, 2.0, 50.0}) {
    long double exact = static_cast<long double>(x) - std::log1p(static_cast<long double>(x));
    if (std::abs(x) < 0.05) {  // where the difference cancels
      exact = 0;
      long double power = x;
      for (int k = 2; k < 60; ++k) exact += (k % 2 == 0 ? 1 : -1) * (power *= x) / k;
    }
    EXPECT_NEAR(minus_log1p(Pack(x))[0], static_cast<double>(exact), 4e-15 * std::abs(static_cast<double>(exact))) << x;
    EXPECT_DOUBLE_EQ(log1p(Pack(x))[0], std::log1p(x));
  }
}

}  // namespace

}  // namespace fsi::test
