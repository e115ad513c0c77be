#pragma once

#include <cstddef>
#include <vector>

namespace fsi {

/// A small square matrix, factorised by elimination with complete pivoting, rows and columns first scaled to their
/// largest entries ([Golub2013]): says what is determined where the matrix is singular.
class CompletePivoting {
 public:
  /// \param matrix  row by row, of `size` rows and columns
  /// \param last    columns (true) in which pivots are sought when there are no others
  CompletePivoting(std::vector<double> matrix, std::size_t size, const std::vector<bool>& last = {});

  bool singular() const { return rank_ < size_; }
  /// Columns without pivot: unknowns that the equations leave open.
  std::vector<std::size_t> open_columns() const;

  /// A solution of A x = b, zero in open columns.
  /// \returns the largest residual that no x removes, in units of the scaled rows
  double solve(const std::vector<double>& right, std::vector<double>& x) const;

 private:
  double& at(std::size_t row, std::size_t column) { return matrix_[row * size_ + column]; }
  double at(std::size_t row, std::size_t column) const { return matrix_[row * size_ + column]; }

  std::vector<double> matrix_;  ///< factors, rows and columns in the order of pivots
  std::size_t size_, rank_ = 0;
  std::vector<double> row_scales_, column_scales_;
  std::vector<std::size_t> rows_, columns_;  ///< of A, in the order of pivots
};

}  // namespace fsi
