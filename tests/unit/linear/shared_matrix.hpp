#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "algebra/csr_matrix.hpp"
#include "parallel/exchange.hpp"

namespace fsi::test {

/// All processes of the test. A function: before main() there are none.
inline const Communicator& everyone() {
  return Communicator::world();
}

/// A process's stretch of the rows of a matrix that all processes have; columns of copies behind those of own rows.
struct SharedGraph {
  ShareOfNumbers share;
  std::vector<int> offsets{0}, columns;  ///< by items of the share
  std::vector<int> positions;            ///< of the entries in the whole matrix

  SharedGraph(const Communicator& processes, const std::vector<int>& all_offsets, const std::vector<int>& all_columns) {
    const std::int64_t rows = static_cast<std::int64_t>(all_offsets.size()) - 1;
    const auto begin_of = [&](int rank) { return static_cast<int>(rows * rank / processes.size()); };
    const int begin = begin_of(processes.rank()), end = begin_of(processes.rank() + 1);
    std::vector<std::int64_t> copies;
    for (int at = all_offsets[begin]; at < all_offsets[end]; ++at)
      if (all_columns[at] < begin || all_columns[at] >= end) copies.push_back(all_columns[at]);
    std::sort(copies.begin(), copies.end());
    copies.erase(std::unique(copies.begin(), copies.end()), copies.end());
    share = ShareOfNumbers(processes, end - begin, copies);
    for (int row = begin; row < end; ++row) {
      std::vector<std::pair<int, int>> entries;
      for (int at = all_offsets[row]; at < all_offsets[row + 1]; ++at) {
        const auto copy = std::lower_bound(copies.begin(), copies.end(), all_columns[at]) - copies.begin();
        const bool own = all_columns[at] >= begin && all_columns[at] < end;
        entries.emplace_back(own ? all_columns[at] - begin : end - begin + static_cast<int>(copy), at);
      }
      std::sort(entries.begin(), entries.end());
      for (const auto& [column, at] : entries) {
        columns.push_back(column);
        positions.push_back(at);
      }
      offsets.push_back(static_cast<int>(columns.size()));
    }
  }
};

struct SharedMatrix {
  SharedGraph graph;
  CsrMatrix<double> matrix;

  SharedMatrix(const Communicator& processes, const CsrMatrix<double>& whole)
      : graph(processes, whole.offsets, whole.indices) {
    matrix = {graph.share.items(), graph.offsets, graph.columns, {}};
    for (const int at : graph.positions) matrix.values.push_back(whole.values[at]);
  }
};

}  // namespace fsi::test
