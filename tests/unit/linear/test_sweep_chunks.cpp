// In which order sweeps see their rows.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <atomic>
#include <vector>

#include "host/threads.hpp"
#include "linear/amg/sweep_chunks.hpp"

namespace fsi::test {

namespace {

/// Columns of a tridiagonal matrix.
std::vector<std::vector<int>> tridiagonal(int rows) {
  std::vector<std::vector<int>> columns(rows);
  for (int row = 0; row < rows; ++row)
    for (int column = std::max(0, row - 1); column <= std::min(rows - 1, row + 1); ++column)
      columns[row].push_back(column);
  return columns;
}

SweepChunks chunks_of(int rows) {
  std::vector<int> offsets{0}, columns;
  for (const auto& row : tridiagonal(rows)) {
    columns.insert(columns.end(), row.begin(), row.end());
    offsets.push_back(static_cast<int>(columns.size()));
  }
  return SweepChunks(offsets, columns);
}

TEST(SweepChunks, SeeEachRowOnceAndAfterItsNeighbourInTheChunk) {
  for (const int size : {1, 7, 3199, 3200, 3203}) {
    const SweepChunks chunks = chunks_of(size);
    EXPECT_EQ(chunks.chunks(), size < 3200 ? 1 : 8);
    std::vector<int> chunk(size);
    for (int c = 0; c < chunks.chunks(); ++c)
      for (int row = chunks.begin[c]; row < chunks.begin[c + 1]; ++row) chunk[row] = c;
    for (const int count : {1, 2, 4, 5, 8, 11}) {
      set_threads(count);
      // clang's OpenMP does not free all of a team that grows beyond four threads; the address sanitizer reports that.
      omp_set_num_threads(std::min(count, 4));
      std::vector<int> seen(size, 0);
      std::atomic<int> too_early{0};
      chunks.forward([&](int row) {
        if (row > 0 && chunk[row - 1] == chunk[row] && !seen[row - 1]) ++too_early;
        ++seen[row];
      });
      EXPECT_EQ(seen, std::vector<int>(size, 1)) << count << " threads";
      chunks.backward([&](int row) {
        if (row + 1 < size && chunk[row + 1] == chunk[row] && seen[row + 1] != 2) ++too_early;
        ++seen[row];
      });
      EXPECT_EQ(seen, std::vector<int>(size, 2)) << count << " threads";
      EXPECT_EQ(too_early, 0) << count << " threads";
    }
  }
  set_threads(0);
}

/// The same couplings within chunks, wherever they are stored.
TEST(SweepChunks, OfTrianglesAreThoseOfTheWhole) {
  for (const int size : {1, 7, 3203}) {
    const SweepChunks whole = chunks_of(size);
    const SplitBlocks<2> split(tridiagonal(size));
    const SweepChunks chunks(split, size);
    EXPECT_EQ(chunks.begin, whole.begin);
    for (int row = 0; row < size; ++row) {
      EXPECT_EQ(chunks.diagonal[row] - chunks.first[row], whole.diagonal[row] - whole.first[row]) << row;
      EXPECT_EQ(chunks.diagonal[row], split.lower_end(row));
      EXPECT_EQ(chunks.last[row] - split.upper_begin(row), whole.last[row] - whole.diagonal[row] - 1) << row;
    }
  }
}

}  // namespace

}  // namespace fsi::test
