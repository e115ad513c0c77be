#pragma once

#include <algorithm>
#include <cassert>
#include <vector>

#include "algebra/node_graph.hpp"
#include "algebra/split_blocks.hpp"
#include "host/parallel_for.hpp"
#include "host/threads.hpp"

namespace fsi {

/// Rows of a matrix in contiguous chunks of fixed number. Gauss-Seidel runs row after row within a chunk and side by
/// side over the chunks, couplings between chunks left out: parallel, and the same numbers for any number of threads.
/// A thread with several chunks goes through two of them in turn, row by row: a row depends on the one before it in its
/// chunk, so that the processor works on the other chunk's row meanwhile.
struct SweepChunks {
  static constexpr int count = 8;
  static constexpr int smallest = 400;  ///< rows; smaller matrices are one chunk
  /// Chunks of each of several processes: about as many couplings are left out as by one.
  static constexpr int count_of_each(int processes) { return std::max(2, count / processes); }

  std::vector<int> begin;  ///< chunks + 1 rows
  /// Per row, positions of its first entry within the chunk, of its diagonal, and one past its last within the chunk.
  std::vector<int> first, diagonal, last;

  int chunks() const { return static_cast<int>(begin.size()) - 1; }
  int rows() const { return begin.empty() ? 0 : begin.back(); }

  /// Calls visit(row) for all rows, those of a chunk in ascending order.
  template <class Visit>
  void forward(Visit visit) const {
    const int together = chunks_together();
    parallel_for(chunks() / together, chunks() > 1, [&](int part) {
      for (int k = 0; k < longest; ++k)
        for (int i = part * together; i < (part + 1) * together; ++i)
          if (begin[i] + k < begin[i + 1]) visit(begin[i] + k);
    });
  }
  /// Likewise, in descending order.
  template <class Visit>
  void backward(Visit visit) const {
    const int together = chunks_together();
    parallel_for(chunks() / together, chunks() > 1, [&](int part) {
      for (int k = 1; k <= longest; ++k)
        for (int i = part * together; i < (part + 1) * together; ++i)
          if (begin[i + 1] - k >= begin[i]) visit(begin[i + 1] - k);
    });
  }

  SweepChunks() = default;
  /// \param offsets, columns  sparsity by rows, columns ascending, every diagonal entry present
  /// \param chunks            one or an even number, since a thread may take them in pairs
  SweepChunks(const std::vector<int>& offsets, const std::vector<int>& columns, int chunks = count) {
    divide(static_cast<int>(offsets.size()) - 1, chunks);
    for_rows([&](int row, int from, int to) {
      int at = offsets[row];
      while (columns[at] < from) ++at;
      first[row] = at;
      while (columns[at] < row) ++at;
      assert(at < offsets[row + 1] && columns[at] == row);
      diagonal[row] = at;
      while (at < offsets[row + 1] && columns[at] < to) ++at;
      last[row] = at;
    });
  }
  /// Of triangles: `first` and `diagonal` are positions in the lower one, which ends at the diagonal, `last` in the upper one.
  /// \param rows  the first of a's, which are divided
  template <int n>
  SweepChunks(const SplitBlocks<n>& a, int rows, int chunks = count) {
    divide(rows, chunks);
    for_rows([&](int row, int from, int to) {
      int at = a.lower_begin(row);
      while (at < a.lower_end(row) && a.lower.columns[at] < from) ++at;
      first[row] = at;
      diagonal[row] = a.lower_end(row);
      at = a.upper_begin(row);
      while (at < a.upper_end(row) && a.upper.columns[at] < to) ++at;
      last[row] = at;
    });
  }

 private:
  void divide(int size, int chunks) {
    const int parts = size < chunks * smallest ? 1 : chunks;
    for (int c = 0; c <= parts; ++c) begin.push_back(static_cast<int>(static_cast<long long>(size) * c / parts));
    for (int c = 0; c < parts; ++c) longest = std::max(longest, begin[c + 1] - begin[c]);
    for (auto* positions : {&first, &diagonal, &last}) positions->resize(size);
  }
  /// Calls visit(row, first row of its chunk, first row of the next).
  template <class Visit>
  void for_rows(Visit visit) const {
    for (int c = 0; c < chunks(); ++c)
      for (int row = begin[c]; row < begin[c + 1]; ++row) visit(row, begin[c], begin[c + 1]);
  }

  /// Two chunks where every thread then still has some.
  int chunks_together() const { return 2 * threads() <= chunks() ? 2 : 1; }

  int longest = 0;  ///< rows of a chunk
};

}  // namespace fsi
