#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

namespace fsi {

// Starts of a power iteration: rough, and the same each time, so that a restarted run finds the same numbers.

/// The numbers (2654435761 i mod 1024) / 512 - 1, in [-1, 1).
inline std::vector<double> rough_vector(std::size_t size) {
  std::vector<double> x(size);
  for (std::size_t i = 0; i < size; ++i) x[i] = (static_cast<unsigned>(i) * 2654435761u % 1024) / 512.0 - 1;
  return x;
}

/// A sequence of numbers in [-0.5, 0.5) from a linear congruential generator.
class RoughSequence {
 public:
  double operator()() {
    seed_ = seed_ * 1664525u + 1013904223u;
    return static_cast<double>(seed_ >> 8) / (1 << 24) - 0.5;
  }

 private:
  unsigned seed_ = 1;
};

/// Power iteration: growth of the iterate in each of some steps, estimates of the eigenvalue largest by size.
/// \param step  x <- A x; returns |A x| / |x|, or 0 when there is nothing left to multiply, which ends the iteration
template <class Step>
std::vector<double> power_iteration(int iterations, Step step) {
  assert(iterations > 0);
  std::vector<double> growth;
  for (int k = 0; k < iterations; ++k) {
    growth.push_back(step());
    if (!(growth.back() > 0)) break;
  }
  return growth;
}

/// Size of A's largest eigenvalue, an estimate from below for symmetric A; a few percent take a dozen iterations.
/// \param x        start
/// \param product  product(x, y) sets y = A x, both of the start's size
template <class Product>
double largest_eigenvalue(std::vector<double> x, int iterations, Product product) {
  std::vector<double> y(x.size());
  const auto growth = power_iteration(iterations, [&] {
    product(x, y);
    double sum = 0;
    for (double value : y) sum += value * value;
    const double length = std::sqrt(sum);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = y[i] / length;
    return length;  // of A x with |x| = 1, from the second step on
  });
  return growth.back();
}

/// The limit of three estimates that approach it like a geometric sequence (Aitken); at most `share` beyond the last.
inline double extrapolated_limit(double first, double second, double third, double share) {
  const double earlier = second - first, later = third - second;
  const double rest = earlier > later && later > 0 ? later * later / (earlier - later) : 0;
  return third + std::min(rest, share * third);
}

}  // namespace fsi
