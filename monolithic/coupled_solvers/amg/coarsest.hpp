#pragma once

#include <cstddef>
#include <vector>

#include "algebra/block_matrix.hpp"
#include "linear/direct/direct_solver.hpp"

namespace fsi {

/// Direct solver of a block matrix, all entries being unknowns: the coarsest level of a hierarchy.
template <int Size>
class CoarsestSolver {
 public:
  /// Factorises; the pattern must be that of the first call.
  /// \throws ConvergenceError where a pivot is zero or not finite, OutOfMemory
  void update(const BlockMatrix<Size, Size>& a) {
    if (matrix_.offsets.empty()) make_pattern(*a.graph);
    for (std::size_t k = 0; k < source_.size(); ++k) matrix_.values[k] = a.values[source_[k]];
    solver_.factorise(matrix_);
  }
  /// x = A^-1 b. \throws ConvergenceError where the matrix is singular to working precision
  void solve(const std::vector<double>& b, std::vector<double>& x) const { solver_.solve(matrix_, b, x); }
  std::size_t bytes() const {
    return 16 * static_cast<std::size_t>(solver_.factor_nonzeros()) + matrix_.values.size() * 24;
  }

 private:
  void make_pattern(const NodeGraph& graph) {
    const std::int64_t columns = static_cast<std::int64_t>(graph.rows()) * Size;
    matrix_.offsets.assign(static_cast<std::size_t>(columns) + 1, 0);
    for (int column : graph.columns)
      for (int c = 0; c < Size; ++c) matrix_.offsets[static_cast<std::size_t>(column) * Size + c + 1] += Size;
    for (std::int64_t c = 0; c < columns; ++c) matrix_.offsets[c + 1] += matrix_.offsets[c];
    matrix_.rows.resize(matrix_.offsets.back());
    matrix_.values.resize(matrix_.offsets.back());
    source_.resize(matrix_.offsets.back());
    std::vector<std::int64_t> next(matrix_.offsets.begin(), matrix_.offsets.end() - 1);
    for (int row = 0; row < graph.rows(); ++row)
      for (int r = 0; r < Size; ++r)
        for (int at = graph.offsets[row]; at < graph.offsets[row + 1]; ++at)
          for (int c = 0; c < Size; ++c) {
            auto& to = next[static_cast<std::size_t>(graph.columns[at]) * Size + c];
            matrix_.rows[to] = static_cast<std::int64_t>(row) * Size + r;
            source_[to++] = (static_cast<std::size_t>(at) * Size + r) * Size + c;
          }
  }

  SparseMatrix matrix_;
  std::vector<std::size_t> source_;  ///< where each entry comes from
  DirectSolver solver_;
};

}  // namespace fsi
