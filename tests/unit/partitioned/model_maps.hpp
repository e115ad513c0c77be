#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "algebra/vector_operations.hpp"
#include "partitioned/accelerators/accelerator.hpp"

namespace fsi::test {

/// A map x -> x~ like that of an incompressible fluid and a light wall: each mode's error is overshot by -g, g from
/// 0.1 to about 100, the modes being no unit vectors; with `cubic` its answer stiffens.
struct AddedMassMap {
  int size;
  double cubic = 0;
  double shift = 0;  ///< moves the solution, as time does

  double gain(int mode) const { return 0.1 * std::pow(1000.0, size > 1 ? mode / (size - 1.0) : 1.0); }

  /// r = x~ - x = Q (b - (1 + G) Q x - cubic (Q x)^3), Q a reflection.
  std::vector<double> residual(const std::vector<double>& x) const {
    std::vector<double> r = reflected(x);
    for (int i = 0; i < size; ++i) r[i] = std::cos(i + shift) - (1 + gain(i)) * r[i] - cubic * r[i] * r[i] * r[i];
    return reflected(r);
  }

 private:
  std::vector<double> reflected(std::vector<double> x) const {
    std::vector<double> mirror(size);
    for (int i = 0; i < size; ++i) mirror[i] = 1.0 / (1 + i);
    axpy(-2 * dot(mirror, x) / dot(mirror, mirror), mirror, x);
    return x;
  }
};

/// Corrections that an accelerator needs for |r| <= tolerance times the first one, one time step; `limit` if it fails.
/// \param history  receives |r| of every pass
inline int corrections(Accelerator& accelerator, const AddedMassMap& map, std::vector<double>& x, double tolerance,
                       int limit = 500, std::vector<double>* history = nullptr) {
  accelerator.start();
  double first = 0;
  for (int k = 0; k < limit; ++k) {
    const auto r = map.residual(x);
    if (k == 0) first = norm(r);
    if (history) history->push_back(norm(r));
    if (norm(r) <= tolerance * first) {
      accelerator.accept(x, r);
      return k;
    }
    accelerator.correct(x, r);
  }
  return limit;
}

inline bool all_finite(const std::vector<double>& x) {
  for (double value : x)
    if (!std::isfinite(value)) return false;
  return true;
}

}  // namespace fsi::test
