#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "math/tensor.hpp"

namespace fsi {

/// Von Mises' equivalent stress sqrt(3/2 dev sigma : dev sigma) of a symmetric tensor, in its unit. From differences of
/// the diagonal, so that a large pressure cancels without loss of digits.
inline double von_mises_stress(const Mat3<double>& s) {
  const double xy = s(0, 0) - s(1, 1), yz = s(1, 1) - s(2, 2), zx = s(2, 2) - s(0, 0);
  const double shear = s(0, 1) * s(0, 1) + s(1, 2) * s(1, 2) + s(0, 2) * s(0, 2);
  return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3 * shear);
}

/// The eigenvalues of a symmetric tensor, the largest first, by Jacobi's rotations [Golub2013, section 8.5].
inline std::array<double, 3> principal_stresses(Mat3<double> s) {
  constexpr int most_sweeps = 30;
  const double size = std::sqrt(contract(s, s));
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    if (std::sqrt(s(0, 1) * s(0, 1) + s(1, 2) * s(1, 2) + s(0, 2) * s(0, 2)) <= 1e-16 * size) break;
    for (const auto& [p, q] : {std::array<int, 2>{0, 1}, std::array<int, 2>{1, 2}, std::array<int, 2>{0, 2}}) {
      if (s(p, q) == 0) continue;
      const double tau = (s(q, q) - s(p, p)) / (2 * s(p, q));
      const double t = (tau >= 0 ? 1 : -1) / (std::abs(tau) + std::sqrt(1 + tau * tau));
      const double c = 1 / std::sqrt(1 + t * t), sine = t * c;
      for (int k = 0; k < 3; ++k) {
        const double a = s(k, p), b = s(k, q);
        s(k, p) = c * a - sine * b;
        s(k, q) = sine * a + c * b;
      }
      for (int k = 0; k < 3; ++k) {
        const double a = s(p, k), b = s(q, k);
        s(p, k) = c * a - sine * b;
        s(q, k) = sine * a + c * b;
      }
    }
  }
  std::array<double, 3> values{s(0, 0), s(1, 1), s(2, 2)};
  std::sort(values.begin(), values.end(), [](double a, double b) { return a > b; });
  return values;
}

}  // namespace fsi
