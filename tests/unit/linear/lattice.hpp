#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "algebra/block_matrix.hpp"

namespace fsi::test {

/// A lattice of m x m x m nodes, held at x = 0, with springs along edges and diagonals: k d d^T for a spring of
/// direction d. Like elasticity it hardly sees rigid motions.
struct Lattice {
  BlockMatrix<3, 3> matrix;
  std::vector<std::array<double, 3>> points;

  explicit Lattice(int m) {
    auto graph = std::make_shared<NodeGraph>();
    graph->offsets.push_back(0);
    const auto for_neighbours = [m](int i, auto visit) {
      const int at[3] = {i / (m * m), i / m % m, i % m};
      for (int x = at[0] - 1; x <= at[0] + 1; ++x)
        for (int y = at[1] - 1; y <= at[1] + 1; ++y)
          for (int z = at[2] - 1; z <= at[2] + 1; ++z)
            visit((x * m + y) * m + z, std::array<double, 3>{double(x - at[0]), double(y - at[1]), double(z - at[2])},
                  x < m && std::min(y, z) >= 0 && std::max(y, z) < m, x < 0);
    };
    for (int i = 0; i < m * m * m; ++i) {
      points.push_back({double(i / (m * m)), double(i / m % m), double(i % m)});
      for_neighbours(i, [&](int j, const auto&, bool inside, bool wall) {
        if (inside && !wall) graph->columns.push_back(j);
      });
      graph->offsets.push_back(graph->columns.size());
    }
    matrix = BlockMatrix<3, 3>(graph);
    for (int i = 0; i < m * m * m; ++i) {
      double* diagonal = matrix.block(graph->find(i, i));
      for_neighbours(i, [&](int j, const auto& d, bool inside, bool wall) {
        if (!inside || (j == i && !wall)) return;
        double* block = wall ? nullptr : matrix.block(graph->find(i, j));
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) {
            diagonal[r * 3 + c] += d[r] * d[c];
            if (block) block[r * 3 + c] -= d[r] * d[c];
          }
      });
    }
  }
};

}  // namespace fsi::test
