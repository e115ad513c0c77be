#pragma once

#include <cstddef>

#include "algebra/registers.hpp"

namespace fsi {

/// Products with dense columns of some ten to a hundred rows, as in sparse factors. Explicit SIMD accumulation with a
/// fixed order of sums: compilers make sums of sixteen lanes, which they add up one by one at each short column's end.

/// to -= columns times x: `rows` numbers at `to`, `width` numbers at x.
/// \param columns  the first number of `width` columns of `rows` numbers
/// \param pitch    from a column's number to the next column's
inline void subtract_combination(const float* columns, int pitch, int rows, int width, const float* x, float* to) {
  int j = 0;
  for (; j + 4 <= width; j += 4) {
    const float *b0 = columns + static_cast<std::size_t>(j) * pitch, *b1 = b0 + pitch, *b2 = b1 + pitch,
                *b3 = b2 + pitch;
    const float x0 = x[j], x1 = x[j + 1], x2 = x[j + 2], x3 = x[j + 3];
    int i = 0;
    for (; i + 8 <= rows; i += 8)
      store<8>(load<8>(to + i) -
                   ((load<8>(b0 + i) * x0 + load<8>(b1 + i) * x1) + (load<8>(b2 + i) * x2 + load<8>(b3 + i) * x3)),
               to + i);
    if (i + 4 <= rows) {
      store<4>(load<4>(to + i) -
                   ((load<4>(b0 + i) * x0 + load<4>(b1 + i) * x1) + (load<4>(b2 + i) * x2 + load<4>(b3 + i) * x3)),
               to + i);
      i += 4;
    }
    for (; i < rows; ++i) to[i] -= (b0[i] * x0 + b1[i] * x1) + (b2[i] * x2 + b3[i] * x3);
  }
  for (; j < width; ++j) {
    const float* b = columns + static_cast<std::size_t>(j) * pitch;
    int i = 0;
    for (; i + 8 <= rows; i += 8) store<8>(load<8>(to + i) - load<8>(b + i) * x[j], to + i);
    for (; i < rows; ++i) to[i] -= b[i] * x[j];
  }
}

/// y -= columns^T x: `width` numbers at y, `rows` numbers at x. Other parameters as above.
inline void subtract_products(const float* columns, int pitch, int rows, int width, const float* x, float* y) {
  int j = 0;
  for (; j + 4 <= width; j += 4) {
    const float *b0 = columns + static_cast<std::size_t>(j) * pitch, *b1 = b0 + pitch, *b2 = b1 + pitch,
                *b3 = b2 + pitch;
    Register<8> s0{}, s1{}, s2{}, s3{};
    int i = 0;
    for (; i + 8 <= rows; i += 8) {
      const Register<8> value = load<8>(x + i);
      s0 += load<8>(b0 + i) * value;
      s1 += load<8>(b1 + i) * value;
      s2 += load<8>(b2 + i) * value;
      s3 += load<8>(b3 + i) * value;
    }
    Register<4> t0 = folded(s0), t1 = folded(s1), t2 = folded(s2), t3 = folded(s3);
    if (i + 4 <= rows) {
      const Register<4> value = load<4>(x + i);
      t0 += load<4>(b0 + i) * value;
      t1 += load<4>(b1 + i) * value;
      t2 += load<4>(b2 + i) * value;
      t3 += load<4>(b3 + i) * value;
      i += 4;
    }
    Register<4> sums = sums_of_lanes(t0, t1, t2, t3);
    for (; i < rows; ++i) sums += Register<4>{b0[i], b1[i], b2[i], b3[i]} * x[i];
    store<4>(load<4>(y + j) - sums, y + j);
  }
  for (; j < width; ++j) {
    const float* b = columns + static_cast<std::size_t>(j) * pitch;
    Register<8> sum{};
    int i = 0;
    for (; i + 8 <= rows; i += 8) sum += load<8>(b + i) * load<8>(x + i);
    float rest = 0;
    for (; i < rows; ++i) rest += b[i] * x[i];
    y[j] -= rest + sum_of_lanes(folded(sum));
  }
}

/// y = L^-1 y, L being unit lower triangular; its columns have `width` numbers, those on and above the diagonal unused.
/// Four columns at a time, whose rows below are updated together.
inline void solve_unit_lower(const float* triangle, int width, float* y) {
  for (int first = 0; first < width; first += 4) {
    const int end = first + 4 < width ? first + 4 : width;
    const float* columns = triangle + static_cast<std::size_t>(first) * width;
    for (int j = first; j < end; ++j)
      for (int i = j + 1; i < end; ++i) y[i] -= columns[(j - first) * width + i] * y[j];
    subtract_combination(columns + end, width, width - end, end - first, y + first, y + end);
  }
}

/// y = L^-T y
inline void solve_unit_lower_transposed(const float* triangle, int width, float* y) {
  for (int first = (width - 1) / 4 * 4; first >= 0; first -= 4) {
    const int end = first + 4 < width ? first + 4 : width;
    const float* columns = triangle + static_cast<std::size_t>(first) * width;
    subtract_products(columns + end, width, width - end, end - first, y + end, y + first);
    for (int j = end - 2; j >= first; --j)
      for (int i = j + 1; i < end; ++i) y[j] -= columns[(j - first) * width + i] * y[i];
  }
}

}  // namespace fsi
