#pragma once

#include <cstddef>
#include <vector>

#include "algebra/block_matrix.hpp"
#include "monolithic/coupled_solvers/amg/coarsening.hpp"

namespace fsi {

/// Calls update(row) for all rows, colour by colour, forwards or backwards: a Gauss-Seidel sweep whose result does not
/// depend on the number of threads, since rows of one colour do not couple.
template <class Update>
inline void sweep_colours(const RowColours& colours, bool backward, bool threaded, Update update) {
  const int count = colours.colours();
#pragma omp parallel if (threaded)
  for (int k = 0; k < count; ++k) {
    const int colour = backward ? count - 1 - k : k;
#pragma omp for schedule(static)
    for (int at = colours.offsets[colour]; at < colours.offsets[colour + 1]; ++at) update(colours.rows[at]);
  }
}

/// Gauss-Seidel smoother for a matrix that does not couple components, all components at once:
///   x_i <- (b_i - sum_{j != i} a_ij x_j) / a_ii
template <int Components, int Numbers>
class GaussSeidel {
 public:
  using Matrix = BlockMatrix<1, Numbers>;

  explicit GaussSeidel(const Matrix& a) : colours_(colour_rows(*a.graph)), inverse_(a.graph->rows() * Numbers) {}

  /// New values on the same pattern.
  void update(const Matrix& a) {
    for (int i = 0; i < a.graph->rows(); ++i)
      for (int k = 0; k < Numbers; ++k) inverse_[i * Numbers + k] = 1 / a.block(a.graph->find(i, i))[k];
  }

  void smooth(const Matrix& a, const std::vector<double>& b, std::vector<double>& x, int steps, bool backward) const {
    const NodeGraph& graph = *a.graph;
    const auto row = [&](int i) {
      double sum[Components];
      for (int k = 0; k < Components; ++k) sum[k] = b[static_cast<std::size_t>(i) * Components + k];
      for (int at = graph.offsets[i]; at < graph.offsets[i + 1]; ++at) {
        const double* number = a.block(at);
        const double* from = x.data() + static_cast<std::size_t>(graph.columns[at]) * Components;
        for (int k = 0; k < Components; ++k) sum[k] -= number[Numbers == 1 ? 0 : k] * from[k];
      }
      // The row's own term was subtracted with the others: x_i += residual_i / a_ii.
      double* to = x.data() + static_cast<std::size_t>(i) * Components;
      for (int k = 0; k < Components; ++k)
        to[k] += sum[k] * inverse_[static_cast<std::size_t>(i) * Numbers + (Numbers == 1 ? 0 : k)];
    };
    for (int s = 0; s < steps; ++s) sweep_colours(colours_, backward, graph.blocks() > 200000, row);
  }

  std::size_t bytes() const {
    return inverse_.size() * sizeof(double) + (colours_.rows.size() + colours_.offsets.size()) * sizeof(int);
  }

 private:
  RowColours colours_;
  std::vector<double> inverse_;
};

}  // namespace fsi
