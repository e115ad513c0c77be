#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "algebra/register_blocks.hpp"

namespace fsi {

/// A sparse matrix of dense n x n blocks in single precision as its lower triangle, the diagonal in it, and what lies above,
/// rows from the last to the first: either half of a symmetric Gauss-Seidel sweep reads one of them from its beginning to its
/// end. Of whole rows it would need a half each, while the processor prefetches what follows, the other half; and towards
/// lower addresses not all processors prefetch as well (docs/guide/solvers.md#speed).
template <int n>
struct SplitBlocks {
  static constexpr int stride = RegisterBlocks<n, n>::stride;  ///< floats a block

  RegisterBlocks<n, n> lower;  ///< the last block of a row is on the diagonal
  RegisterBlocks<n, n> upper;  ///< its row k is that of node rows() - 1 - k

  SplitBlocks() = default;
  /// \param rows  columns of each row, ascending, the diagonal among them
  explicit SplitBlocks(const std::vector<std::vector<int>>& rows) {
    const int count = static_cast<int>(rows.size());
    for (int v = 0; v < count; ++v) append(lower, rows[v].begin(), above(rows[v], v));
    for (int v = count - 1; v >= 0; --v) append(upper, above(rows[v], v), rows[v].end());
    for (auto* half : {&lower, &upper}) half->values.assign(half->columns.size() * stride, 0.0f);
  }

  int rows() const { return lower.rows(); }
  int lower_begin(int v) const { return lower.offsets[v]; }
  int lower_end(int v) const { return lower.offsets[v + 1]; }
  int upper_begin(int v) const { return upper.offsets[rows() - 1 - v]; }
  int upper_end(int v) const { return upper.offsets[rows() - v]; }

  /// Of a block among all, the lower ones first. It must be there.
  int position(int row, int column) const {
    return column <= row
               ? find(lower, lower_begin(row), lower_end(row), column)
               : static_cast<int>(lower.columns.size()) + find(upper, upper_begin(row), upper_end(row), column);
  }
  float* block(int position) { return const_cast<float*>(std::as_const(*this).block(position)); }
  /// n columns of padded<n> numbers.
  const float* block(int position) const {
    const std::size_t at = position, below = lower.columns.size();
    return at < below ? lower.values.data() + at * stride : upper.values.data() + (at - below) * stride;
  }
  /// Calls visit(column, position) for the blocks of a row, columns ascending.
  template <class Visit>
  void for_row(int v, Visit visit) const {
    for (int at = lower_begin(v); at < lower_end(v); ++at) visit(lower.columns[at], at);
    for (int at = upper_begin(v); at < upper_end(v); ++at)
      visit(upper.columns[at], static_cast<int>(lower.columns.size()) + at);
  }
  void clear_row(int v) {
    std::fill(lower.values.begin() + std::ptrdiff_t{lower_begin(v)} * stride,
              lower.values.begin() + std::ptrdiff_t{lower_end(v)} * stride, 0.0f);
    std::fill(upper.values.begin() + std::ptrdiff_t{upper_begin(v)} * stride,
              upper.values.begin() + std::ptrdiff_t{upper_end(v)} * stride, 0.0f);
  }

  Register<n> row_product(int v, const float* x) const {
    return lower.product(lower_begin(v), lower_end(v), x) + upper.product(upper_begin(v), upper_end(v), x);
  }
  std::size_t bytes() const { return lower.bytes() + upper.bytes(); }

 private:
  using Columns = std::vector<int>::const_iterator;
  static Columns above(const std::vector<int>& columns, int row) {
    return std::upper_bound(columns.begin(), columns.end(), row);
  }
  static void append(RegisterBlocks<n, n>& to, Columns begin, Columns end) {
    to.columns.insert(to.columns.end(), begin, end);
    to.offsets.push_back(static_cast<int>(to.columns.size()));
  }
  static int find(const RegisterBlocks<n, n>& half, int begin, int end, int column) {
    const auto from = half.columns.begin();
    return static_cast<int>(std::lower_bound(from + begin, from + end, column) - from);
  }
};

}  // namespace fsi
