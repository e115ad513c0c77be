#include "algebra/sparse_matrix.hpp"

namespace fsi {

std::vector<double> product(const SparseMatrix& a, const std::vector<double>& x) {
  std::vector<double> y(static_cast<std::size_t>(a.size()), 0.0);
  for (std::int64_t c = 0; c < a.size(); ++c)
    for (std::int64_t k = a.offsets[c]; k < a.offsets[c + 1]; ++k) y[a.rows[k]] += a.values[k] * x[c];
  return y;
}

}  // namespace fsi
