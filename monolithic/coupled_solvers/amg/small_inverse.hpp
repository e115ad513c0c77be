#pragma once

#include <cmath>
#include <utility>

namespace fsi {

/// Inverts a dense row-major matrix of `size` rows in place by Gauss-Jordan elimination with row pivoting.
/// \param pivots  room for `size` numbers
/// \returns false where a pivot is below 1e-300 or not a number, `a` then being overwritten in part. A matrix that is
/// singular to rounding may pass
inline bool invert_in_place(double* a, int size, int* pivots) {
  for (int k = 0; k < size; ++k) {
    int pivot = k;
    for (int r = k + 1; r < size; ++r)
      if (std::abs(a[r * size + k]) > std::abs(a[pivot * size + k])) pivot = r;
    pivots[k] = pivot;
    if (!(std::abs(a[pivot * size + k]) > 1e-300)) return false;
    if (pivot != k)
      for (int c = 0; c < size; ++c) std::swap(a[k * size + c], a[pivot * size + c]);
    const double inverse = 1 / a[k * size + k];
    a[k * size + k] = 1;
    for (int c = 0; c < size; ++c) a[k * size + c] *= inverse;
    for (int r = 0; r < size; ++r) {
      if (r == k) continue;
      const double factor = a[r * size + k];
      if (factor == 0) continue;
      a[r * size + k] = 0;
      for (int c = 0; c < size; ++c) a[r * size + c] -= factor * a[k * size + c];
    }
  }
  for (int k = size - 1; k >= 0; --k)
    if (pivots[k] != k)
      for (int r = 0; r < size; ++r) std::swap(a[r * size + k], a[r * size + pivots[k]]);
  return true;
}

}  // namespace fsi
