#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "math/dual.hpp"
#include "math/transpose.hpp"

namespace fsi::test {

namespace {

using D = Dual<2>;

/// x with dx/ds0 = 1, and y with dy/ds1 = 1; lane l holds x + l / 10.
D seeded(double value, int seed) {
  D d(Pack(0.0));
  for (int lane = 0; lane < pack_width; ++lane) d.value.set(lane, value + 0.1 * lane);
  d.slope[seed] = Pack(1.0);
  return d;
}

/// Value and both slopes in every lane against closed forms f(x, y), f_x(x, y), f_y(x, y).
template <class F, class Fx, class Fy>
void expect_dual(const D& z, double x, double y, F f, Fx fx, Fy fy) {
  for (int lane = 0; lane < pack_width; ++lane) {
    const double a = x + 0.1 * lane, b = y + 0.1 * lane;
    EXPECT_NEAR(z.value[lane], f(a, b), 4e-16 * (1 + std::abs(f(a, b))));
    EXPECT_NEAR(z.slope[0][lane], fx(a, b), 8e-16 * (1 + std::abs(fx(a, b))));
    EXPECT_NEAR(z.slope[1][lane], fy(a, b), 8e-16 * (1 + std::abs(fy(a, b))));
  }
}

constexpr double x0 = 1.3, y0 = -0.7;  // y stays away from zero in every lane of up to four, x positive
const double y_start = pack_width > 4 ? -1.7 : y0;
const D x = seeded(x0, 0), y = seeded(y_start, 1);
const auto zero = [](double, double) { return 0.0; };
const auto one = [](double, double) { return 1.0; };
const auto minus_one = [](double, double) { return -1.0; };

TEST(Dual, ArithmeticOfTwoVariables) {
  const auto check = [](const D& z, auto f, auto fx, auto fy) { expect_dual(z, x0, y_start, f, fx, fy); };
  check(
      x + y, [](double a, double b) { return a + b; }, one, one);
  check(
      x - y, [](double a, double b) { return a - b; }, one, minus_one);
  check(
      x * y, [](double a, double b) { return a * b; }, [](double, double b) { return b; },
      [](double a, double) { return a; });
  check(
      x / y, [](double a, double b) { return a / b; }, [](double, double b) { return 1 / b; },
      [](double a, double b) { return -a / (b * b); });
  check(
      -x, [](double a, double) { return -a; }, minus_one, zero);
  D sum = x;
  sum += y;
  check(
      sum, [](double a, double b) { return a + b; }, one, one);
  D rest = x;
  rest -= y;
  check(
      rest, [](double a, double b) { return a - b; }, one, minus_one);
}

TEST(Dual, ArithmeticWithConstants) {
  const auto check = [](const D& z, auto f, auto fx) { expect_dual(z, x0, y_start, f, fx, zero); };
  const auto two_and_half = [](double, double) { return 2.5; };
  for (const bool as_pack : {false, true}) {
    const auto with = [&](auto operation) { return as_pack ? operation(Pack(2.5)) : operation(2.5); };
    check(
        with([](auto c) { return x + c; }), [](double a, double) { return a + 2.5; }, one);
    check(
        with([](auto c) { return c + x; }), [](double a, double) { return a + 2.5; }, one);
    check(
        with([](auto c) { return x - c; }), [](double a, double) { return a - 2.5; }, one);
    check(
        with([](auto c) { return c - x; }), [](double a, double) { return 2.5 - a; }, minus_one);
    check(
        with([](auto c) { return x * c; }), [](double a, double) { return 2.5 * a; }, two_and_half);
    check(
        with([](auto c) { return c * x; }), [](double a, double) { return 2.5 * a; }, two_and_half);
    check(
        with([](auto c) { return x / c; }), [](double a, double) { return a / 2.5; },
        [](double, double) { return 0.4; });
    check(
        with([](auto c) { return c / x; }), [](double a, double) { return 2.5 / a; },
        [](double a, double) { return -2.5 / (a * a); });
  }
  D sum = x;
  sum += Pack(2.5);
  check(
      sum, [](double a, double) { return a + 2.5; }, one);
  D rest = x;
  rest -= Pack(2.5);
  check(
      rest, [](double a, double) { return a - 2.5; }, one);
  expect_dual(
      D(3.0), 0, 0, [](double, double) { return 3.0; }, zero, zero);
}

TEST(Dual, Functions) {
  const auto check = [](const D& z, auto f, auto fx) { expect_dual(z, x0, y_start, f, fx, zero); };
  check(
      sqrt(x), [](double a, double) { return std::sqrt(a); }, [](double a, double) { return 0.5 / std::sqrt(a); });
  check(
      exp(x), [](double a, double) { return std::exp(a); }, [](double a, double) { return std::exp(a); });
  check(
      cbrt(x), [](double a, double) { return std::cbrt(a); }, [](double a, double) { return std::cbrt(a) / (3 * a); });
}

// The cube root against that of long double, from the smallest number to the largest and below zero. Where a lane holds no
// usual number all are the C library's, which promises four units of the last place.
TEST(Pack, CubeRootIsExactToRounding) {
  EXPECT_EQ(cbrt(Pack(1.0))[0], 1.0);
  EXPECT_EQ(cbrt(Pack(0.0))[0], 0.0);
  EXPECT_TRUE(std::isnan(cbrt(Pack(std::nan("")))[0]));
  std::vector<double> usual, unusual{5e-324, 1e-300, 1e300, -8.0, -1e-70};
  for (double a = 1e-59; a < 1e59; a *= 1.37) usual.push_back(a);
  for (double a = 0.5; a < 8; a += 0.001) usual.push_back(a);
  const auto check = [](double a, double beside, double tolerance) {
    Pack pack(beside);
    pack.set(pack_width - 1, a);
    const Pack roots = cbrt(pack);
    const long double root = std::cbrt(static_cast<long double>(a));
    EXPECT_NEAR(static_cast<double>(roots[pack_width - 1] / root), 1, tolerance) << a;
    EXPECT_EQ(roots[0], beside) << a;
  };
  for (const double a : usual) {
    check(a, 1.0, 2.3e-16);
    check(a, 0.0, 8.9e-16);
  }
  for (const double a : unusual) check(a, 1.0, 8.9e-16);
}

// A number makes lanes that are equal to the last bit, the sign of zero among them.
TEST(Pack, LanesOfANumberAreThatNumber) {
  const Pack minus(-0.0);
  for (int lane = 0; lane < pack_width; ++lane) EXPECT_TRUE(std::signbit(minus[lane]));
}

TEST(Pack, TransposeExchangesLanesAndPlaces) {
  Pack square[pack_width];
  for (int i = 0; i < pack_width; ++i)
    for (int lane = 0; lane < pack_width; ++lane) square[i].set(lane, 10 * i + lane);
  transpose(square);
  for (int i = 0; i < pack_width; ++i)
    for (int lane = 0; lane < pack_width; ++lane) EXPECT_EQ(square[i][lane], 10 * lane + i);
}

// phi(a) = (exp(a) - 1) / a against sums in long double, from the smallest number to the largest that does not overflow.
TEST(Dual, PhiIsAccurateForEveryNumber) {
  const auto sum_of = [](long double a, bool slope) {
    long double sum = 0, term = 1;  // a^k / (k + 1)!
    for (int k = 0; k < 2000; ++k) {
      sum += slope ? term * (k + 1) / (k + 2) : term;
      term *= a / (k + 2);
    }
    return static_cast<double>(sum);
  };
  EXPECT_EQ(phi(Pack(0.0))[0], 1.0);
  EXPECT_EQ(phi_slope(Pack(0.0))[0], 0.5);
  for (const double a :
       {5e-324, 1e-310, 1e-200, 1e-17, 1e-9, 1e-3, 0.3, 0.99, 1.0, 1.01, 3.0, 30.0, 300.0, 690.0, -1e-9, -0.5, -1.0}) {
    Dual<1> argument{Pack(a)};
    argument.slope[0] = Pack(2.0);
    const Dual<1> result = phi(argument);
    EXPECT_NEAR(result.value[0] / sum_of(a, false), 1, 4e-16 * std::max(1.0, std::abs(a))) << a;
    EXPECT_NEAR(0.5 * result.slope[0][0] / sum_of(a, true), 1, 2e-15 * std::max(1.0, std::abs(a))) << a;
  }
}

TEST(Dual, SelectTakesValueAndSlopeLaneByLane) {
  const double threshold = x0 + 0.05;  // lane 0 below, all others above
  const D z = select(x > threshold, x * x, y);
  for (int lane = 0; lane < pack_width; ++lane) {
    const bool above = lane > 0;
    EXPECT_DOUBLE_EQ(z.value[lane], above ? (x * x).value[lane] : y.value[lane]);
    EXPECT_DOUBLE_EQ(z.slope[0][lane], above ? 2 * x.value[lane] : 0.0);
    EXPECT_DOUBLE_EQ(z.slope[1][lane], above ? 0.0 : 1.0);
  }
}

TEST(Dual, ChainRuleThroughACompositeFunction) {
  // f = exp(x y) / sqrt(x + y^2), f_x = f (y - 1/(2 (x + y^2))), f_y = f (x - y/(x + y^2)), by hand.
  const D z = exp(x * y) / sqrt(x + y * y);
  const auto f = [](double a, double b) { return std::exp(a * b) / std::sqrt(a + b * b); };
  expect_dual(
      z, x0, y_start, f, [&](double a, double b) { return f(a, b) * (b - 0.5 / (a + b * b)); },
      [&](double a, double b) { return f(a, b) * (a - b / (a + b * b)); });
}

TEST(Pack, LanesLoadAndStand) {
  double numbers[pack_width];
  for (int lane = 0; lane < pack_width; ++lane) numbers[lane] = lane + 0.5;
  Pack p = Pack::load(numbers);
  for (int lane = 0; lane < pack_width; ++lane) EXPECT_EQ(p[lane], lane + 0.5);
  p.set(1, -4.0);
  EXPECT_EQ(p[0], 0.5);
  EXPECT_EQ(p[1], -4.0);
  const Pack all(3.0);
  for (int lane = 0; lane < pack_width; ++lane) EXPECT_EQ(all[lane], 3.0);
}

TEST(Pack, ArithmeticIsLaneByLane) {
  Pack a(2.0), b(5.0);
  a.set(1, -3.0);
  b.set(1, 0.5);
  EXPECT_EQ((a + b)[0], 7.0);
  EXPECT_EQ((a + b)[1], -2.5);
  EXPECT_EQ((a - b)[0], -3.0);
  EXPECT_EQ((a - b)[1], -3.5);
  EXPECT_EQ((a * b)[0], 10.0);
  EXPECT_EQ((a * b)[1], -1.5);
  EXPECT_EQ((a / b)[0], 0.4);
  EXPECT_EQ((a / b)[1], -6.0);
  EXPECT_EQ((-a)[1], 3.0);
  a += b;
  a *= Pack(2.0);
  a -= Pack(1.0);
  EXPECT_EQ(a[0], 13.0);
  EXPECT_EQ(a[1], -6.0);
}

TEST(Pack, MasksChooseAndReport) {
  Pack a(1.0);
  EXPECT_FALSE(any(a > Pack(1.0)));
  a.set(pack_width - 1, 2.0);
  EXPECT_TRUE(any(a > Pack(1.0)));
  const Pack chosen = select(a > Pack(1.0), Pack(10.0), Pack(20.0));
  EXPECT_EQ(chosen[0], 20.0);
  EXPECT_EQ(chosen[pack_width - 1], 10.0);
}

}  // namespace

}  // namespace fsi::test
