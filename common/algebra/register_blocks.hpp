#pragma once

#include <cstddef>
#include <vector>

#include "algebra/block_matrix.hpp"
#include "algebra/registers.hpp"

namespace fsi {

/// A dense block times a vector; columns of padded<R> numbers.
template <int R, int C>
inline Register<R> block_times(const float* block, const float* x) {
  Register<R> sum{};
  for (int k = 0; k < C; ++k) sum += load<R>(block + k * padded<R>) * x[k];
  return sum;
}

/// A sparse matrix of dense R x C blocks in single precision, arranged so that products run over whole registers:
/// columns of a block are padded. Vectors hold padded<R> or padded<C> floats per node.
template <int R, int C>
struct RegisterBlocks {
  static constexpr int stride = C * padded<R>;  ///< floats per block

  std::vector<int> offsets{0}, columns;
  std::vector<float> values;

  RegisterBlocks() = default;
  explicit RegisterBlocks(const BlockMatrix<R, C>& a)
      : offsets(a.graph->offsets), columns(a.graph->columns), values(columns.size() * stride, 0.0f) {
    for (std::size_t at = 0; at < columns.size(); ++at)
      for (int r = 0; r < R; ++r)
        for (int c = 0; c < C; ++c)
          values[at * stride + c * padded<R> + r] = static_cast<float>(a.block(static_cast<int>(at))[r * C + c]);
  }

  int rows() const { return static_cast<int>(offsets.size()) - 1; }
  std::size_t bytes() const { return values.size() * sizeof(float) + (columns.size() + offsets.size()) * sizeof(int); }

  /// Blocks begin ... end - 1, of one row, times x. One accumulator per column keeps the chains of additions short.
  Register<R> product(int begin, int end, const float* x) const {
    if constexpr (R == 2 && C == 2) return product_of_small(begin, end, x);
    Register<R> parts[C] = {};
    const float* a = values.data() + static_cast<std::size_t>(begin) * stride;
    for (int at = begin; at < end; ++at, a += stride) {
      __builtin_prefetch(reinterpret_cast<const char*>(a) + prefetch_distance);
      const float* from = x + static_cast<std::size_t>(columns[at]) * padded<C>;
      for (int k = 0; k < C; ++k) parts[k] += load<R>(a + k * padded<R>) * from[k];
    }
    Register<R> sum = parts[0];
    for (int k = 1; k < C; ++k) sum += parts[k];
    return sum;
  }
  /// The same for 2 x 2 blocks, each of which fills a register; even and odd ones have an accumulator each.
  Register<2> product_of_small(int begin, int end, const float* x) const {
    const float* a = values.data() + static_cast<std::size_t>(begin) * 4;
    const auto by_columns = [&](int at) {
      const Register<2> here = load<2>(x + static_cast<std::size_t>(columns[at]) * 2);
      return __builtin_shufflevector(here, here, 0, 0, 1, 1);
    };
    Register<4> even{}, odd{};
    int at = begin;
    for (; at + 1 < end; at += 2, a += 8) {
      even += load<4>(a) * by_columns(at);
      odd += load<4>(a + 4) * by_columns(at + 1);
    }
    if (at < end) even += load<4>(a) * by_columns(at);
    even += odd;
    return __builtin_shufflevector(even, even, 0, 1) + __builtin_shufflevector(even, even, 2, 3);
  }
  Register<R> row_product(int row, const float* x) const { return product(offsets[row], offsets[row + 1], x); }

  /// y = A x
  void multiply(const std::vector<float>& x, std::vector<float>& y) const {
#pragma omp parallel for schedule(static) if (columns.size() > 5000)
    for (int row = 0; row < rows(); ++row)
      store<R>(row_product(row, x.data()), y.data() + static_cast<std::size_t>(row) * padded<R>);
  }
};

}  // namespace fsi
