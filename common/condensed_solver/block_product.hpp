#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "algebra/block_matrix.hpp"

namespace fsi {

/// A B for sparse matrices of dense blocks; the pattern is made on the way. Rows in parallel, each entry is summed in a
/// fixed order.
/// \param columns  block columns of B
template <int R, int M, int C>
BlockMatrix<R, C> block_product(const BlockMatrix<R, M>& a, const BlockMatrix<M, C>& b, int columns) {
  const NodeGraph &left = *a.graph, &right = *b.graph;
  const int rows = left.rows();
  auto graph = std::make_shared<NodeGraph>();
  graph->offsets.assign(static_cast<std::size_t>(rows) + 1, 0);
  const auto for_pairs = [&](int row, auto visit) {
    for (int i = left.offsets[row]; i < left.offsets[row + 1]; ++i)
      for (int k = right.offsets[left.columns[i]]; k < right.offsets[left.columns[i] + 1]; ++k) visit(i, k);
  };
#pragma omp parallel
  {
    std::vector<int> seen(columns, -1);  // last row that touched a column
#pragma omp for schedule(static)
    for (int row = 0; row < rows; ++row)
      for_pairs(row, [&](int, int k) {
        if (seen[right.columns[k]] == row) return;
        seen[right.columns[k]] = row;
        ++graph->offsets[row + 1];
      });
  }
  for (int row = 0; row < rows; ++row) graph->offsets[row + 1] += graph->offsets[row];
  graph->columns.resize(graph->offsets[rows]);
  BlockMatrix<R, C> c;
  c.values.assign(graph->columns.size() * R * C, 0.0);
#pragma omp parallel
  {
    std::vector<int> seen(columns, -1), place(columns);
#pragma omp for schedule(static)
    for (int row = 0; row < rows; ++row) {
      int* const first = graph->columns.data() + graph->offsets[row];
      int* last = first;
      for_pairs(row, [&](int, int k) {
        if (seen[right.columns[k]] == row) return;
        seen[right.columns[k]] = row;
        *last++ = right.columns[k];
      });
      std::sort(first, last);
      for (const int* column = first; column < last; ++column)
        place[*column] = static_cast<int>(column - graph->columns.data());
      for_pairs(row, [&](int i, int k) {
        const double *x = a.block(i), *y = b.block(k);
        double* to = c.values.data() + static_cast<std::size_t>(place[right.columns[k]]) * R * C;
        for (int r = 0; r < R; ++r)
          for (int m = 0; m < M; ++m)
            for (int s = 0; s < C; ++s) to[r * C + s] += x[r * M + m] * y[m * C + s];
      });
    }
  }
  c.graph = std::move(graph);
  return c;
}

/// The transpose.
/// \param columns  block columns of A
template <int R, int C>
BlockMatrix<C, R> transposed(const BlockMatrix<R, C>& a, int columns) {
  const NodeGraph& from = *a.graph;
  auto graph = std::make_shared<NodeGraph>();
  graph->offsets.assign(static_cast<std::size_t>(columns) + 1, 0);
  for (int column : from.columns) ++graph->offsets[static_cast<std::size_t>(column) + 1];
  for (int row = 0; row < columns; ++row) graph->offsets[row + 1] += graph->offsets[row];
  graph->columns.resize(from.columns.size());
  std::vector<int> next(graph->offsets.begin(), graph->offsets.end() - 1);
  BlockMatrix<C, R> t;
  t.values.resize(a.values.size());
  for (int row = 0; row < from.rows(); ++row)
    for (int at = from.offsets[row]; at < from.offsets[row + 1]; ++at) {
      const int to = next[from.columns[at]]++;
      graph->columns[to] = row;
      for (int r = 0; r < R; ++r)
        for (int c = 0; c < C; ++c) t.values[static_cast<std::size_t>(to) * R * C + c * R + r] = a.block(at)[r * C + c];
    }
  t.graph = std::move(graph);
  return t;
}

}  // namespace fsi
