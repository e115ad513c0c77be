#pragma once

#include <utility>

#include "math/pack.hpp"

namespace fsi {

namespace detail {

/// Swaps the halves of blocks of 2 h lanes between x, which keeps its first halves, and y, which keeps its second ones.
template <int h, int... lane>
inline void exchange_halves(Pack& x, Pack& y, std::integer_sequence<int, lane...>) {
  const Pack::Lanes first = x.lanes, second = y.lanes;
  x.lanes = __builtin_shufflevector(first, second, ((lane & h) == 0 ? lane : pack_width + lane - h)...);
  y.lanes = __builtin_shufflevector(first, second, ((lane & h) == 0 ? lane + h : pack_width + lane)...);
}

}  // namespace detail

/// Transposes a square of numbers: lane i of x[j] becomes lane j of x[i]. By halves, quarters, ... of the square.
template <int h = pack_width / 2>
inline void transpose(Pack (&x)[pack_width]) {
  if constexpr (h > 0) {
    for (int i = 0; i < pack_width; ++i)
      if ((i & h) == 0) detail::exchange_halves<h>(x[i], x[i + h], std::make_integer_sequence<int, pack_width>{});
    transpose<h / 2>(x);
  }
}

}  // namespace fsi
