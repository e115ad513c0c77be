#pragma once

#include <cstdint>
#include <vector>

namespace fsi {

/// A sparse matrix by columns, row numbers ascending in each: the form that sparse direct solvers take.
struct SparseMatrix {
  std::vector<std::int64_t> offsets;  ///< columns + 1
  std::vector<std::int64_t> rows;
  std::vector<double> values;

  std::int64_t size() const { return static_cast<std::int64_t>(offsets.size()) - 1; }
  std::int64_t nonzeros() const { return static_cast<std::int64_t>(rows.size()); }
};

/// y = A x for a square matrix.
std::vector<double> product(const SparseMatrix& a, const std::vector<double>& x);

}  // namespace fsi
