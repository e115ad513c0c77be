#pragma once

#include <cmath>
#include <vector>

namespace fsi::test {

/// A smooth function on an interval by its values at Chebyshev points, evaluated by the barycentric formula
/// [Berrut2004]: cheap where the function itself is an integral. A little outside of the interval is fine.
class PolynomialFit {
 public:
  template <class Function>
  PolynomialFit(double from, double to, int points, Function function) {
    for (int i = 0; i < points; ++i) {
      const double angle = (i + 0.5) * std::acos(-1.0) / points;
      at_.push_back(0.5 * (from + to) + 0.5 * (to - from) * std::cos(angle));
      values_.push_back(function(at_.back()));
      weights_.push_back((i % 2 == 0 ? 1 : -1) * std::sin(angle));
    }
  }

  double operator()(double x) const {
    double above = 0, below = 0;
    for (std::size_t i = 0; i < at_.size(); ++i) {
      const double distance = x - at_[i];
      if (distance == 0) return values_[i];
      above += weights_[i] / distance * values_[i];
      below += weights_[i] / distance;
    }
    return above / below;
  }

 private:
  std::vector<double> at_, values_, weights_;
};

/// Integral by Gauss's rule of three points on equal intervals.
template <class Function>
double gauss_integral(double from, double to, int intervals, Function function) {
  const double h = (to - from) / intervals, reach = std::sqrt(0.15);
  double sum = 0;
  for (int i = 0; i < intervals; ++i) {
    const double middle = from + (i + 0.5) * h;
    sum += h / 18 * (5 * function(middle - reach * h) + 8 * function(middle) + 5 * function(middle + reach * h));
  }
  return sum;
}

}  // namespace fsi::test
