#pragma once

#include <array>
#include <memory>
#include <vector>

#include "algebra/block_matrix.hpp"
#include "support/random.hpp"

namespace fsi::test {

/// Nodes of an n x n x n grid; neighbours differ by at most `reach` in each index (27 points), or along one axis only.
inline std::shared_ptr<const NodeGraph> grid_graph(int n, bool axes_only = false) {
  auto graph = std::make_shared<NodeGraph>();
  graph->offsets.push_back(0);
  const auto inside = [&](int i) { return i >= 0 && i < n; };
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        for (int dk = -1; dk <= 1; ++dk)
          for (int dj = -1; dj <= 1; ++dj)
            for (int di = -1; di <= 1; ++di) {
              if (axes_only && di * di + dj * dj + dk * dk > 1) continue;
              if (inside(i + di) && inside(j + dj) && inside(k + dk))
                graph->columns.push_back(i + di + n * (j + dj + n * (k + dk)));
            }
        graph->offsets.push_back(static_cast<int>(graph->columns.size()));
      }
  return graph;
}

/// The seven-point Laplacian with Dirichlet conditions beyond the grid, times h^2.
inline BlockMatrix<1, 1> grid_laplacian(int n) {
  BlockMatrix<1, 1> a(grid_graph(n, true));
  for (int i = 0; i < a.graph->rows(); ++i)
    for (int at = a.graph->offsets[i]; at < a.graph->offsets[i + 1]; ++at)
      a.values[at] = a.graph->columns[at] == i ? 6.0 : -1.0;
  return a;
}

template <int Rows, int Columns>
BlockMatrix<Rows, Columns> random_matrix(std::shared_ptr<const NodeGraph> graph, unsigned seed) {
  BlockMatrix<Rows, Columns> a(std::move(graph));
  Random random(seed);
  for (double& v : a.values) v = random();
  return a;
}

inline std::vector<double> random_vector(std::size_t size, unsigned seed = 3) {
  std::vector<double> x(size);
  Random random(seed);
  for (double& v : x) v = random();
  return x;
}

}  // namespace fsi::test
