// Functions of packs against the C library in long double, over the whole range of doubles.
#include "math/pack.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

namespace fsi::test {

namespace {

constexpr double rounding = std::numeric_limits<double>::epsilon() / 2;

/// The largest relative error of f in random numbers of the ranges, all lanes different.
template <class Function, class Exact>
double largest_error(Function f, Exact exact, double low, double high) {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> number(low, high);
  double largest = 0;
  for (int n = 0; n < 20000; ++n) {
    Pack x;
    for (int lane = 0; lane < pack_width; ++lane) x.set(lane, number(generator));
    const Pack y = f(x);
    for (int lane = 0; lane < pack_width; ++lane) {
      const long double expected = exact(static_cast<long double>(x[lane]));
      largest = std::max(largest, static_cast<double>(std::abs(y[lane] / expected - 1)));
    }
  }
  return largest;
}

TEST(Pack, ExponentialIsRightToRounding) {
  const auto f = [](Pack x) { return exp(x); };
  const auto exact = [](long double x) { return std::exp(x); };
  for (const double range : {1e-9, 1e-2, 1.0, 10.0, 690.0})
    EXPECT_LE(largest_error(f, exact, -range, range), 2 * rounding) << range;
}

TEST(Pack, RelativeExponentialIsRightToRoundingAlsoNearZero) {
  const auto f = [](Pack x) { return phi(x); };
  const auto exact = [](long double x) { return std::expm1(x) / x; };
  for (const double range : {1e-9, 1e-2, 1.0, 10.0, 690.0})
    EXPECT_LE(largest_error(f, exact, -range, range), 4 * rounding) << range;
  EXPECT_EQ(phi(Pack(0.0))[0], 1);
}

TEST(Pack, ExponentialOfWhatHasNoUsualOneIsTheLibrarys) {
  for (const double x : {-800.0, -745.0, 709.0, 720.0, std::numeric_limits<double>::infinity()}) {
    Pack some(0.5);
    some.set(0, x);
    EXPECT_EQ(exp(some)[0], std::exp(x)) << x;
    EXPECT_EQ(exp(some)[pack_width - 1], std::exp(0.5));
  }
  EXPECT_TRUE(std::isnan(exp(Pack(std::nan("")))[0]));
  EXPECT_TRUE(std::isnan(phi(Pack(std::nan("")))[0]));
}

TEST(Pack, CubeRootIsRightToRounding) {
  const auto f = [](Pack x) { return cbrt(x); };
  const auto exact = [](long double x) { return std::cbrt(x); };
  for (const auto& [low, high] : {std::pair{0.5, 2.0}, {1e-9, 1e-6}, {1e20, 1e30}})
    EXPECT_LE(largest_error(f, exact, low, high), 4 * rounding) << low;
}

}  // namespace

}  // namespace fsi::test
