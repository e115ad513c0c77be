#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace fsi::test {

/// Uniform numbers in [-1, 1), the same on every platform (the standard's distributions are not).
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()() { return std::ldexp(static_cast<double>(engine_() >> 11), -52) - 1.0; }

 private:
  std::mt19937_64 engine_;
};

/// Nodal values of a random field: a few long waves of height `smooth` plus noise of height `rough` from node to node.
/// \param x        node positions, mm
/// \param entries  numbers per node
template <class Point>
std::vector<double> random_field(const std::vector<Point>& x, int entries, double smooth, double rough, unsigned seed) {
  constexpr int waves = 3;
  Random random(seed);
  std::vector<double> field(x.size() * entries);
  for (int k = 0; k < entries; ++k) {
    double height[waves], number[waves][3], phase[waves];
    for (int m = 0; m < waves; ++m) {
      height[m] = smooth * (0.5 + 0.5 * random()) / waves;
      for (double& component : number[m]) component = 4 * random();
      phase[m] = 3 * random();
    }
    for (std::size_t a = 0; a < x.size(); ++a) {
      double value = rough * random();
      for (int m = 0; m < waves; ++m)
        value +=
            height[m] * std::sin(number[m][0] * x[a][0] + number[m][1] * x[a][1] + number[m][2] * x[a][2] + phase[m]);
      field[a * entries + k] = value;
    }
  }
  return field;
}

}  // namespace fsi::test
