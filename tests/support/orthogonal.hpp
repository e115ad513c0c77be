#pragma once

#include <cmath>

#include "math/tensor.hpp"
#include "mesh/simplex_mesh.hpp"
#include "support/random.hpp"

namespace fsi::test {

inline Point turn(const Mat3<double>& q, const Point& x) {
  Point y{0, 0, 0};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) y[i] += q(i, j) * x[j];
  return y;
}

/// A pseudo-random orthogonal map that keeps the element's kind of body: rotations, and at odd seeds reflections. In the
/// plane for plane bodies; for bodies of revolution z -> -z alone, at odd seeds.
template <class Element>
Mat3<double> orthogonal(unsigned seed) {
  Mat3<double> q{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  if constexpr (!Element::axisymmetric) {
    Random random(seed + 1);
    const auto rotate = [&](int i, int j) {
      const double angle = 3.14 * random();
      Mat3<double> step{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
      step(i, i) = step(j, j) = std::cos(angle);
      step(i, j) = -std::sin(angle);
      step(j, i) = std::sin(angle);
      q = step * q;
    };
    rotate(0, 1);
    if constexpr (Element::dim == 3) {
      rotate(1, 2);
      rotate(0, 1);
    }
  }
  const int mirrored = Element::axisymmetric || Element::dim == 3 ? 2 : 0;
  if (seed % 2 == 1)
    for (int j = 0; j < 3; ++j) q(mirrored, j) = -q(mirrored, j);
  return q;
}

}  // namespace fsi::test
