#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "algebra/block_products.hpp"
#include "mesh_motion/harmonic_extension.hpp"
#include "support/random.hpp"

namespace fsi::test {

/// Seven-point Laplacian on m x m x m nodes, the last component scaled on demand; random values given on the boundary.
struct ExtensionProblem {
  BlockMatrix<1, 3> laplacian;
  std::vector<char> inner;
  std::vector<double> right, field;

  explicit ExtensionProblem(int m, double last = 1) {
    auto graph = std::make_shared<NodeGraph>();
    graph->offsets.push_back(0);
    const int stride[3] = {m * m, m, 1};
    for (int i = 0; i < m * m * m; ++i) {
      const int place[3] = {i / (m * m), i / m % m, i % m};
      for (int k = 0; k < 3; ++k)
        if (place[k] > 0) graph->columns.push_back(i - stride[k]);
      graph->columns.push_back(i);
      for (int k = 2; k >= 0; --k)
        if (place[k] < m - 1) graph->columns.push_back(i + stride[k]);
      graph->offsets.push_back(static_cast<int>(graph->columns.size()));
      const bool boundary = *std::min_element(place, place + 3) == 0 || *std::max_element(place, place + 3) == m - 1;
      inner.insert(inner.end(), 3, !boundary);
    }
    laplacian = BlockMatrix<1, 3>(graph);
    for (int row = 0; row < graph->rows(); ++row)
      for (int at = graph->offsets[row]; at < graph->offsets[row + 1]; ++at)
        for (int k = 0; k < 3; ++k)
          laplacian.block(at)[k] = (graph->columns[at] == row ? 6.0 : -1.0) * (k == 2 ? last : 1.0);
    Random random(7);
    for (std::size_t i = 0; i < inner.size(); ++i) {
      right.push_back(0.1 * random());
      field.push_back(random());
    }
  }

  /// Largest |right - A field| of the inner entries.
  double residual(const std::vector<double>& solution) const {
    std::vector<double> r(solution.size());
    residual_components<3>(laplacian, right, solution, r);
    double largest = 0;
    for (std::size_t i = 0; i < r.size(); ++i)
      if (inner[i]) largest = std::max(largest, std::abs(r[i]));
    return largest;
  }
};

}  // namespace fsi::test
