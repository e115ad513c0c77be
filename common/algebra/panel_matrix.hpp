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

/// A sparse lower triangular matrix as supernodal factorisations produce it ([Chen2008]): groups of neighbouring
/// columns with the same rows. Group s has the columns first_column[s] ... first_column[s + 1] - 1, the row numbers
/// rows[first_row[s]] ... rows[first_row[s + 1] - 1], its own columns first, and, column by column, a value for each
/// row from values[first_value[s]] on; those above the diagonal are no part of the matrix. The lists first_... have
/// groups + 1 entries.
struct Supernodes {
  int groups = 0;
  const std::int64_t *first_column = nullptr, *first_row = nullptr, *first_value = nullptr;
  const std::int64_t* rows = nullptr;
  const double* values = nullptr;
};

/// A sparse unit lower triangular matrix L in single precision, by panels: neighbouring columns that have (nearly) the
/// same rows below are stored as one dense block, with a list of these rows ([Chen2008]: supernodes). A solve then
/// reads four bytes an entry, in the order in which they lie in memory. One thread at a time may solve.
class PanelMatrix {
 public:
  PanelMatrix() = default;
  /// \param columns  L by columns; entries on or above the diagonal are left out
  explicit PanelMatrix(const CompactColumns<float>& columns);
  /// L of a matrix whose diagonal is not one: each column is divided by its diagonal entry.
  explicit PanelMatrix(const Supernodes& supernodes);

  /// y = L^-1 y for `count` vectors, one behind the other, each with one number per row.
  void solve(float* y, int count = 1) const;
  /// y = L^-T y
  void solve_transposed(float* y, int count = 1) const;

  std::size_t bytes() const;

 private:
  struct Panel {
    int first = 0, width = 0;                           ///< columns
    int rows = 0;                                       ///< below the last of them
    std::size_t row_list = 0, triangle = 0, block = 0;  ///< where its own begin in rows_, triangles_ and blocks_
  };

  void add_panel(const CompactColumns<float>& columns, int first, int end, const std::vector<int>& rows_below);
  /// Appends a panel of `width` columns from `first` on, filled with zeros. \param rows_below  how many
  Panel& append(int first, int width, int rows_below);

  int size_ = 0;  ///< rows
  std::vector<Panel> panels_;
  std::vector<int> rows_;
  std::vector<float> triangles_;         ///< between a panel's own columns, each of `width` numbers
  std::vector<float> blocks_;            ///< below them, each column of `rows` numbers
  mutable std::vector<float> gathered_;  ///< work space of solves: entries of a vector below a panel
};

}  // namespace fsi
