#pragma once

#include <cassert>
#include <cstdint>
#include <limits>
#include <vector>

#include "algebra/sparse_matrix.hpp"

namespace fsi {

/// A sparse matrix whose entries are weighted sums of numbers that element loops left in other arrays (the block
/// matrices of the sub-problems). Where each number goes is worked out once; update() then only adds up, in parallel,
/// each entry in a fixed order.
class GatheredMatrix {
 public:
  /// Collects the terms; all arrays must keep their size and place for the life of the matrix.
  class Builder {
   public:
    static constexpr std::int64_t largest_size = std::numeric_limits<std::int32_t>::max();

    /// \throws InputError when `size` exceeds largest_size
    explicit Builder(std::int64_t size);
    /// Entry (row, column) gets factor * (*number) in every update.
    void add(std::int64_t row, std::int64_t column, const double* number, double factor) {
      assert(row >= 0 && row < size_ && column >= 0 && column < size_);
      terms_.push_back({static_cast<std::int32_t>(row), static_cast<std::int32_t>(column), number, factor});
    }
    void reserve(std::size_t count) { terms_.reserve(count); }

   private:
    friend class GatheredMatrix;
    struct Term {
      std::int32_t row, column;
      const double* number;
      double factor;
    };
    std::int64_t size_;
    std::vector<Term> terms_;
  };

  GatheredMatrix() = default;
  explicit GatheredMatrix(Builder&& builder);

  /// Recomputes all values from the arrays.
  void update();
  const SparseMatrix& matrix() const { return matrix_; }

 private:
  SparseMatrix matrix_;
  std::vector<std::int64_t> term_offsets_;  ///< per entry of the matrix
  std::vector<const double*> numbers_;
  std::vector<double> factors_;
};

}  // namespace fsi
