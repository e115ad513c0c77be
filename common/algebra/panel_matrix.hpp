#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fsi {

/// A sparse square matrix by columns, row numbers ascending in each, in less memory than SparseMatrix takes.
template <class Number>
struct CompactColumns {
  std::vector<std::int64_t> offsets;  ///< columns + 1
  std::vector<int> rows;
  std::vector<Number> values;

  int size() const { return static_cast<int>(offsets.size()) - 1; }
};

/// A sparse unit lower triangular matrix L in single precision, by panels: neighbouring columns that have (nearly) the same
/// rows below are stored as one dense block, with a list of these rows ([Chen2008]: supernodes). A solve then
/// reads four bytes an entry, in the order in which they lie in memory. One thread at a time.
class PanelMatrix {
 public:
  PanelMatrix() = default;
  /// \param columns  L by columns; entries on or above the diagonal are left out
  explicit PanelMatrix(const CompactColumns<float>& columns);

  /// y = L^-1 y, of as many numbers as rows.
  void solve(float* y) const;
  /// y = L^-T y
  void solve_transposed(float* y) const;

  std::size_t bytes() const;

 private:
  struct Panel {
    int first = 0, width = 0;                           ///< columns
    int rows = 0;                                       ///< below the last of them
    std::size_t row_list = 0, triangle = 0, block = 0;  ///< where rows_, triangles_ and blocks_ have what is its own
  };

  void add_panel(const CompactColumns<float>& columns, int first, int end, const std::vector<int>& rows_below);

  std::vector<Panel> panels_;
  std::vector<int> rows_;
  std::vector<float> triangles_;  ///< between a panel's own columns, each of `width` numbers
  std::vector<float> blocks_;     ///< below them, each column of `rows` numbers
  mutable std::vector<float> gathered_;
};

}  // namespace fsi
