#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "algebra/block_matrix.hpp"
#include "algebra/entry_count.hpp"
#include "algebra/vector_operations.hpp"
#include "host/parallel_for.hpp"

namespace fsi {

/// Blocks below which a product stays on one thread.
constexpr int serial_blocks = 40000;

namespace detail {

/// Calls store(row, sum) with sum = row of A x, `Rows` entries, for all rows in parallel. Each row is summed in the
/// order of the graph: the numbers do not depend on the number of threads.
/// \param values  of A, Rows x Columns of them for each pair of nodes in the order of the graph
template <int Rows, int Columns, class Store>
inline void for_each_block_row(const NodeGraph& graph, const double* values, const double* x, Store store) {
  const int rows = graph.rows();
  parallel_for(rows, graph.blocks() > serial_blocks, [&](int row) {
    double sum[Rows] = {};
    for (int at = graph.offsets[row]; at < graph.offsets[row + 1]; ++at) {
      const double* block = values + static_cast<std::size_t>(at) * Rows * Columns;
      const double* from = x + static_cast<std::size_t>(graph.columns[at]) * Columns;
      for (int r = 0; r < Rows; ++r)
        for (int c = 0; c < Columns; ++c) sum[r] += block[r * Columns + c] * from[c];
    }
    store(row, sum);
  });
}
template <int Rows, int Columns, class Store>
inline void for_each_block_row(const BlockMatrix<Rows, Columns>& a, const double* x, Store store) {
  assert(a.values.size() == static_cast<std::size_t>(a.graph->blocks()) * Rows * Columns);
  for_each_block_row<Rows, Columns>(*a.graph, a.values.data(), x, store);
}

/// The same for a matrix with `Numbers` numbers per node pair: one for each of `Components` components, or one for all.
template <int Components, int Numbers, class Store>
inline void for_each_component_row(const NodeGraph& graph, const double* values, const double* x, Store store) {
  static_assert(Numbers == 1 || Numbers == Components, "one number for all components or one for each");
  const int rows = graph.rows();
  parallel_for(rows, graph.blocks() > serial_blocks, [&](int row) {
    double sum[Components] = {};
    for (int at = graph.offsets[row]; at < graph.offsets[row + 1]; ++at) {
      const double* number = values + static_cast<std::size_t>(at) * Numbers;
      const double* from = x + static_cast<std::size_t>(graph.columns[at]) * Components;
      for (int k = 0; k < Components; ++k) sum[k] += number[Numbers == 1 ? 0 : k] * from[k];
    }
    store(row, sum);
  });
}
template <int Components, int Numbers, class Store>
inline void for_each_component_row(const BlockMatrix<1, Numbers>& a, const double* x, Store store) {
  for_each_component_row<Components, Numbers>(*a.graph, a.values.data(), x, store);
}

}  // namespace detail

/// y = A x; y has `Rows` entries per node and is not resized.
template <int Rows, int Columns>
void multiply(const BlockMatrix<Rows, Columns>& a, const std::vector<double>& x, std::vector<double>& y) {
  detail::for_each_block_row(a, x.data(), [&](int row, const double* sum) {
    for (int r = 0; r < Rows; ++r) y[static_cast<std::size_t>(row) * Rows + r] = sum[r];
  });
}

/// y += factor A x
template <int Rows, int Columns>
void multiply_add(const BlockMatrix<Rows, Columns>& a, const std::vector<double>& x, std::vector<double>& y,
                  double factor = 1) {
  detail::for_each_block_row(a, x.data(), [&](int row, const double* sum) {
    for (int r = 0; r < Rows; ++r) y[static_cast<std::size_t>(row) * Rows + r] += factor * sum[r];
  });
}

/// y -= A x
template <int Rows, int Columns>
void multiply_subtract(const BlockMatrix<Rows, Columns>& a, const std::vector<double>& x, std::vector<double>& y) {
  multiply_add(a, x, y, -1);
}

/// r = b - A x; r may be b.
template <int Rows, int Columns>
void residual(const BlockMatrix<Rows, Columns>& a, const std::vector<double>& b, const std::vector<double>& x,
              std::vector<double>& r) {
  detail::for_each_block_row(a, x.data(), [&](int row, const double* sum) {
    for (int k = 0; k < Rows; ++k) {
      const std::size_t i = static_cast<std::size_t>(row) * Rows + k;
      r[i] = b[i] - sum[k];
    }
  });
}

/// y = A x for a matrix that does not couple components: vectors have `Components` entries per node, the matrix one
/// number per node pair for all of them (Numbers = 1) or one for each.
template <int Components, int Numbers>
void multiply_components(const BlockMatrix<1, Numbers>& a, const std::vector<double>& x, std::vector<double>& y) {
  detail::for_each_component_row<Components>(a, x.data(), [&](int row, const double* sum) {
    for (int k = 0; k < Components; ++k) y[static_cast<std::size_t>(row) * Components + k] = sum[k];
  });
}

/// y += factor A x, components uncoupled.
template <int Components, int Numbers>
void multiply_add_components(const BlockMatrix<1, Numbers>& a, const std::vector<double>& x, std::vector<double>& y,
                             double factor = 1) {
  detail::for_each_component_row<Components>(a, x.data(), [&](int row, const double* sum) {
    for (int k = 0; k < Components; ++k) y[static_cast<std::size_t>(row) * Components + k] += factor * sum[k];
  });
}

/// r = b - A x, components uncoupled; r may be b.
template <int Components, int Numbers>
void residual_components(const BlockMatrix<1, Numbers>& a, const std::vector<double>& b, const std::vector<double>& x,
                         std::vector<double>& r) {
  detail::for_each_component_row<Components>(a, x.data(), [&](int row, const double* sum) {
    for (int k = 0; k < Components; ++k) {
      const std::size_t i = static_cast<std::size_t>(row) * Components + k;
      r[i] = b[i] - sum[k];
    }
  });
}

/// A B for sparse matrices of dense blocks, with its pattern. Rows in parallel, each entry is summed in a fixed order.
/// \param columns  block columns of B
template <int R, int M, int C>
BlockMatrix<R, C> block_product(const BlockMatrix<R, M>& a, const BlockMatrix<M, C>& b, int columns) {
  const NodeGraph &left = *a.graph, &right = *b.graph;
  assert(left.blocks() == 0 || *std::max_element(left.columns.begin(), left.columns.end()) < right.rows());
  assert(right.blocks() == 0 || *std::max_element(right.columns.begin(), right.columns.end()) < columns);
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
  for (int row = 0; row < rows; ++row)
    graph->offsets[row + 1] = entry_count(std::int64_t{graph->offsets[row]} + graph->offsets[row + 1]);
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
