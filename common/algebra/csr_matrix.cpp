#include "algebra/csr_matrix.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "algebra/entry_count.hpp"

namespace fsi {

CsrMatrix<double> product(const CsrMatrix<double>& a, const CsrMatrix<double>& b) {
  assert(a.columns == b.rows());
  CsrMatrix<double> c;
  const int rows = a.rows();
  c.columns = b.columns;
  c.offsets.assign(static_cast<std::size_t>(rows) + 1, 0);
#pragma omp parallel
  {
    std::vector<int> seen(b.columns, -1);  // last row that touched a column
#pragma omp for schedule(static)
    for (int row = 0; row < rows; ++row) {
      int count = 0;
      for (int i = a.offsets[row]; i < a.offsets[row + 1]; ++i)
        for (int k = b.offsets[a.indices[i]]; k < b.offsets[a.indices[i] + 1]; ++k)
          if (seen[b.indices[k]] != row) {
            seen[b.indices[k]] = row;
            ++count;
          }
      c.offsets[row + 1] = count;
    }
  }
  for (int row = 0; row < rows; ++row)
    c.offsets[row + 1] = entry_count(std::int64_t{c.offsets[row]} + c.offsets[row + 1]);
  c.indices.resize(c.offsets[rows]);
  c.values.resize(c.offsets[rows]);
#pragma omp parallel
  {
    std::vector<int> seen(b.columns, -1);
    std::vector<double> sums(b.columns);
#pragma omp for schedule(static)
    for (int row = 0; row < rows; ++row) {
      int* columns = c.indices.data() + c.offsets[row];
      int count = 0;
      for (int i = a.offsets[row]; i < a.offsets[row + 1]; ++i)
        for (int k = b.offsets[a.indices[i]]; k < b.offsets[a.indices[i] + 1]; ++k) {
          const int column = b.indices[k];
          const double term = a.values[i] * b.values[k];
          if (seen[column] != row) {
            seen[column] = row;
            columns[count++] = column;
            sums[column] = term;
          } else {
            sums[column] += term;
          }
        }
      std::sort(columns, columns + count);
      for (int k = 0; k < count; ++k) c.values[c.offsets[row] + k] = sums[columns[k]];
    }
  }
  return c;
}

}  // namespace fsi
