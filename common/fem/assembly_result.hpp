#pragma once

#include <algorithm>
#include <vector>

#include "math/pack.hpp"

namespace fsi {

/// What an element loop learns besides the assembled numbers.
struct AssemblyResult {
  double smallest_volume_ratio =
      1;          ///< smallest J at a quadrature point; not positive (or NaN) when an element is inverted
  int cell = -1;  ///< where

  bool inverted() const { return !(smallest_volume_ratio > 0); }
  void include(Pack volume_ratio, const int* cells) {
    for (int lane = 0; lane < pack_width; ++lane)
      if (!(volume_ratio[lane] >= smallest_volume_ratio)) {
        smallest_volume_ratio = volume_ratio[lane];
        cell = cells[lane];
      }
  }
  void include(const AssemblyResult& other) {
    if (!(other.smallest_volume_ratio >= smallest_volume_ratio)) *this = other;
  }
};

/// One result per thread, reduced at the end in the order of the threads.
inline AssemblyResult reduced(const std::vector<AssemblyResult>& of_threads) {
  AssemblyResult all;
  for (const auto& one : of_threads) all.include(one);
  return all;
}

}  // namespace fsi
