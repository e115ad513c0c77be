#pragma once

#include <cmath>
#include <vector>

#include "math/pack.hpp"

namespace fsi {

/// What an element loop finds out besides the assembled numbers.
struct AssemblyResult {
  /// Smallest J at a quadrature point; not positive (or NaN) when an element is inverted.
  double smallest_volume_ratio = 1;
  int cell = -1;  ///< where, numbered as in the sub-problem; -1: J >= 1 everywhere

  bool inverted() const { return !(smallest_volume_ratio > 0); }
  void include(Pack volume_ratio, const int* cells) {
    for (int lane = 0; lane < pack_width; ++lane) include(volume_ratio[lane], cells[lane]);
  }
  void include(const AssemblyResult& other) { include(other.smallest_volume_ratio, other.cell); }

 private:
  void include(double volume_ratio, int of_cell) {
    if (std::isnan(smallest_volume_ratio) || volume_ratio >= smallest_volume_ratio) return;  // NaN stays
    smallest_volume_ratio = volume_ratio;
    cell = of_cell;
  }
};

/// Combines one result per thread, in the order of the threads.
inline AssemblyResult reduced(const std::vector<AssemblyResult>& of_threads) {
  AssemblyResult all;
  for (const auto& one : of_threads) all.include(one);
  return all;
}

}  // namespace fsi
