#pragma once

#include <cassert>
#include <vector>

#include "algebra/node_graph.hpp"

namespace fsi {

/// Rows of a matrix in contiguous chunks of fixed number. Gauss-Seidel runs row after row within a chunk and side by
/// side over the chunks, couplings between chunks left out: parallel, and the same numbers for any number of threads.
struct SweepChunks {
  static constexpr int count = 8;
  static constexpr int smallest = 400;  ///< rows; smaller matrices are one chunk

  std::vector<int> begin;  ///< chunks + 1 rows
  /// Per row, positions of its first entry within the chunk, of its diagonal, and one past its last within the chunk.
  std::vector<int> first, diagonal, last;

  int chunks() const { return static_cast<int>(begin.size()) - 1; }
  int rows() const { return begin.empty() ? 0 : begin.back(); }

  SweepChunks() = default;
  /// \param offsets, columns  sparsity by rows, columns ascending, every diagonal entry present
  SweepChunks(const std::vector<int>& offsets, const std::vector<int>& columns) {
    const int size = static_cast<int>(offsets.size()) - 1;
    const int parts = size < count * smallest ? 1 : count;
    for (int c = 0; c <= parts; ++c) begin.push_back(static_cast<int>(static_cast<long long>(size) * c / parts));
    first.resize(size);
    diagonal.resize(size);
    last.resize(size);
    for (int c = 0; c < parts; ++c)
      for (int row = begin[c]; row < begin[c + 1]; ++row) {
        int at = offsets[row];
        while (columns[at] < begin[c]) ++at;
        first[row] = at;
        while (columns[at] < row) ++at;
        assert(at < offsets[row + 1] && columns[at] == row);
        diagonal[row] = at;
        while (at < offsets[row + 1] && columns[at] < begin[c + 1]) ++at;
        last[row] = at;
      }
  }
};

}  // namespace fsi
