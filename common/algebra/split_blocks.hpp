#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "algebra/registers.hpp"

namespace fsi {

/// A sparse matrix of dense n x n blocks, stored as diagonal, lower and upper triangle, the rows of the latter from the
/// last to the first: either half of a symmetric Gauss-Seidel sweep reads one triangle from its beginning to its end.
/// With whole rows it would use half of each, and the processor would prefetch the other half. Besides, not all
/// processors prefetch as well towards lower addresses (docs/guide/solvers.md#speed).
///
/// The triangles are in 16 bits: a number is an integer of -32767 to 32767 times a scale, one per row of a triangle and
/// component. The diagonal is in single precision and gets what rounding takes from its row. So sums over a row stay as
/// they are, and rounding hardly affects products with smooth vectors, for which most of a row cancels. Products are in
/// single precision.
template <int n>
class SplitBlocks {
 public:
  static constexpr int lanes = padded<n>;
  static constexpr int stride = n * lanes;  ///< numbers per block: n columns of `lanes`

  /// A triangle.
  struct Half {
    std::vector<int> offsets{0}, columns;
    std::vector<std::int16_t> values;
    std::vector<float> scales;  ///< `lanes` per row

    std::size_t bytes() const {
      return values.size() * sizeof(std::int16_t) + scales.size() * sizeof(float) +
             (columns.size() + offsets.size()) * sizeof(int);
    }
  };
  Half lower;                    ///< below the diagonal
  Half upper;                    ///< above it; its row k is that of node rows() - 1 - k
  std::vector<float> diagonals;  ///< `stride` numbers per row

  SplitBlocks() = default;
  /// \param rows  columns of each row, ascending, the diagonal among them
  explicit SplitBlocks(const std::vector<std::vector<int>>& rows) {
    const int count = static_cast<int>(rows.size());
    for (int v = 0; v < count; ++v) append(lower, rows[v].begin(), above(rows[v], v) - 1);
    for (int v = count - 1; v >= 0; --v) append(upper, above(rows[v], v), rows[v].end());
    diagonals.assign(rows.size() * stride, 0.0f);
    for (auto* half : {&lower, &upper}) {
      half->values.assign(half->columns.size() * stride + read_beyond, 0);
      half->scales.assign(rows.size() * lanes, 0.0f);
    }
  }

  int rows() const { return static_cast<int>(lower.offsets.size()) - 1; }
  int lower_begin(int v) const { return lower.offsets[v]; }
  int lower_end(int v) const { return lower.offsets[v + 1]; }
  int upper_begin(int v) const { return upper.offsets[upper_row(v)]; }
  int upper_end(int v) const { return upper.offsets[upper_row(v) + 1]; }

  /// Number of blocks in a row.
  int count(int v) const { return below(v) + 1 + upper_end(v) - upper_begin(v); }
  /// Place of a column's block among those of its row, columns ascending. The block must exist.
  int place(int row, int column) const {
    if (column < row) return find(lower, lower_begin(row), lower_end(row), column);
    return below(row) + (column == row ? 0 : 1 + find(upper, upper_begin(row), upper_end(row), column));
  }

  /// Sets row v to `blocks`, rounded. \param blocks  count(v) times `stride` numbers, columns ascending. If a number is
  /// not finite, neither are products with the row.
  void set_row(int v, const float* blocks) {
    const float* diagonal = blocks + static_cast<std::size_t>(below(v)) * stride;
    float* to = diagonals.data() + static_cast<std::size_t>(v) * stride;
    std::copy_n(diagonal, stride, to);
    round(lower, v, blocks, to);
    round(upper, upper_row(v), diagonal + stride, to);
  }
  /// Calls visit(column, block) for the blocks of a row as stored, columns ascending: n columns of `lanes` numbers.
  template <class Visit>
  void for_row(int v, Visit visit) const {
    const auto visit_half = [&](const Half& half, int row) {
      const float* scale = half.scales.data() + static_cast<std::size_t>(row) * lanes;
      for (int at = half.offsets[row]; at < half.offsets[row + 1]; ++at) {
        float block[stride];
        for (int i = 0; i < stride; ++i)
          block[i] = scale[i % lanes] * half.values[static_cast<std::size_t>(at) * stride + i];
        visit(half.columns[at], static_cast<const float*>(block));
      }
    };
    visit_half(lower, v);
    visit(v, diagonals.data() + static_cast<std::size_t>(v) * stride);
    visit_half(upper, upper_row(v));
  }

  /// Blocks begin ... end - 1 of row v's part of a triangle times x.
  Register<n> lower_product(int v, int begin, int end, const float* x) const {
    return product(lower, v, begin, end, x);
  }
  Register<n> upper_product(int v, int begin, int end, const float* x) const {
    return product(upper, upper_row(v), begin, end, x);
  }
  Register<n> diagonal_product(int v, const float* x) const {
    const float* block = diagonals.data() + static_cast<std::size_t>(v) * stride;
    const Register<n> here = load<n>(x + static_cast<std::size_t>(v) * lanes);
    Register<n> sum{};
    for (int k = 0; k < n; ++k) sum += load<n>(block + k * lanes) * here[k];
    return sum;
  }
  Register<n> row_product(int v, const float* x) const {
    return lower_product(v, lower_begin(v), lower_end(v), x) + diagonal_product(v, x) +
           upper_product(v, upper_begin(v), upper_end(v), x);
  }
  /// Expected square of the error that rounding makes in row v's product with a vector as large as x at all nodes and
  /// without pattern: errors uniformly distributed up to half a unit, at each neighbour and on the diagonal.
  double rounding_squared(int v, const Register<n>& x) const {
    double units = 0, size = 0;
    const auto add = [&](const Half& half, int row) {
      const double count = half.offsets[row + 1] - half.offsets[row];
      for (int i = 0; i < n; ++i) units += count * std::pow(half.scales[static_cast<std::size_t>(row) * lanes + i], 2);
    };
    add(lower, v);
    add(upper, upper_row(v));
    for (int i = 0; i < n; ++i) size += static_cast<double>(x[i]) * x[i];
    return units * size / 6;
  }
  std::size_t bytes() const { return lower.bytes() + upper.bytes() + diagonals.size() * sizeof(float); }

 private:
  static_assert(n == 2 || n == 3);
  using Columns = std::vector<int>::const_iterator;
  static constexpr float largest = 32767;
  /// Numbers that a product may read past the last block.
  static constexpr std::size_t read_beyond = 16;

  int below(int v) const { return lower_end(v) - lower_begin(v); }
  int upper_row(int v) const { return rows() - 1 - v; }
  static Columns above(const std::vector<int>& columns, int row) {
    return std::upper_bound(columns.begin(), columns.end(), row);
  }
  static void append(Half& to, Columns begin, Columns end) {
    to.columns.insert(to.columns.end(), begin, end);
    to.offsets.push_back(static_cast<int>(to.columns.size()));
  }
  /// The column's place, counted from `begin`.
  static int find(const Half& half, int begin, int end, int column) {
    const auto from = half.columns.begin() + begin;
    return static_cast<int>(std::lower_bound(from, half.columns.begin() + end, column) - from);
  }

  /// \param rest  += what rounding takes from each number of a block, over the row
  static void round(Half& half, int row, const float* from, float* rest) {
    const int count = half.offsets[row + 1] - half.offsets[row];
    std::int16_t* to = half.values.data() + static_cast<std::size_t>(half.offsets[row]) * stride;
    for (int i = 0; i < lanes; ++i) {
      float most = 0, zero = 0;  // `zero` becomes NaN where a number is not finite
      for (int at = i; at < count * stride; at += lanes) {
        most = std::max(most, std::abs(from[at]));
        zero += 0 * from[at];
      }
      const float unit = most / largest;
      const bool any = zero == 0 && unit > 0;
      half.scales[static_cast<std::size_t>(row) * lanes + i] =
          zero == 0 ? unit : std::numeric_limits<float>::quiet_NaN();
      for (int at = i; at < count * stride; at += lanes) {
        to[at] = any ? static_cast<std::int16_t>(std::clamp(std::nearbyint(from[at] / unit), -largest, largest))
                     : std::int16_t{0};
        if (any) rest[at % stride] += from[at] - unit * static_cast<float>(to[at]);
      }
    }
  }

  /// Eight integers as a register of floats.
  static Register<8> floats(const std::int16_t* from) {
    using Short = std::int16_t __attribute__((vector_size(16)));
    using Long = std::int32_t __attribute__((vector_size(32)));
    Short x;
    __builtin_memcpy(&x, from, sizeof x);
    return __builtin_convertvector(__builtin_convertvector(x, Long), Register<8>);
  }
  /// Two blocks at a time, whose numbers fill whole registers. What is read past an odd last block is multiplied by 0.
  static Register<n> product(const Half& half, int row, int begin, int end, const float* x) {
    const std::int16_t* a = half.values.data() + static_cast<std::size_t>(begin) * stride;
    const int* columns = half.columns.data();
    const auto node = [&](int at) { return x + static_cast<std::size_t>(columns[at]) * lanes; };
    Register<n> sum;
    if constexpr (n == 3) {
      Register<8> parts[3] = {};
      int at = begin;
      for (; at + 1 < end; at += 2, a += 2 * stride) {
        __builtin_prefetch(reinterpret_cast<const char*>(a) + prefetch_distance);
        const Register<n> f = load<n>(node(at)), g = load<n>(node(at + 1));
        parts[0] += floats(a) * __builtin_shufflevector(f, f, 0, 0, 0, 0, 1, 1, 1, 1);
        parts[1] += floats(a + 8) * __builtin_shufflevector(f, g, 2, 2, 2, 2, 4, 4, 4, 4);
        parts[2] += floats(a + 16) * __builtin_shufflevector(g, g, 1, 1, 1, 1, 2, 2, 2, 2);
      }
      if (at < end) {
        const Register<n> f = load<n>(node(at));
        parts[0] += floats(a) * __builtin_shufflevector(f, f, 0, 0, 0, 0, 1, 1, 1, 1);
        parts[1] += floats(a + 8) * __builtin_shufflevector(f, Register<n>{}, 2, 2, 2, 2, 4, 4, 4, 4);
      }
      sum = folded(parts[0] + parts[1] + parts[2]);
    } else {
      Register<8> parts{};
      const auto by_columns = [](Register<4> two) { return __builtin_shufflevector(two, two, 0, 0, 1, 1, 2, 2, 3, 3); };
      int at = begin;
      for (; at + 1 < end; at += 2, a += 2 * stride) parts += floats(a) * by_columns(two_nodes(node(at), node(at + 1)));
      if (at < end) {
        constexpr float nowhere[lanes] = {};
        parts += floats(a) * by_columns(two_nodes(node(at), nowhere));
      }
      const Register<4> half_sum = folded(parts);
      sum = __builtin_shufflevector(half_sum, half_sum, 0, 1) + __builtin_shufflevector(half_sum, half_sum, 2, 3);
    }
    return sum * load<n>(half.scales.data() + static_cast<std::size_t>(row) * lanes);
  }
  /// Two pairs of floats, each moved as one double: moved float by float they take several times as long.
  static Register<4> two_nodes(const float* first, const float* second) {
    using Two = double __attribute__((vector_size(16)));
    double f, s;
    __builtin_memcpy(&f, first, sizeof f);
    __builtin_memcpy(&s, second, sizeof s);
    const Two both = {f, s};
    Register<4> x;
    __builtin_memcpy(&x, &both, sizeof x);
    return x;
  }
};

}  // namespace fsi
