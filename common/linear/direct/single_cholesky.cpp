#include "linear/direct/single_cholesky.hpp"

#include <algorithm>
#include <cmath>

namespace fsi {

SingleCholesky::SingleCholesky(const Supernodes& factor, const std::int64_t* order)
    : lower_(factor), order_(order, order + factor.first_column[factor.groups]) {
  pivots_.reserve(order_.size());
  for (int s = 0; s < factor.groups; ++s) {
    const std::int64_t rows = factor.first_row[s + 1] - factor.first_row[s];
    for (std::int64_t j = 0; j < factor.first_column[s + 1] - factor.first_column[s]; ++j) {
      const double diagonal = factor.values[factor.first_value[s] + j * rows + j];
      pivots_.push_back(static_cast<float>(1 / (diagonal * diagonal)));
    }
  }
}

void SingleCholesky::solve(const double* b, int count, double* x) const {
  const std::size_t rows = order_.size();
  y_.resize(rows * static_cast<std::size_t>(count));
  std::vector<double> scale(static_cast<std::size_t>(count), 0.0);  // the range of single precision is short
  for (int c = 0; c < count; ++c) {
    const double* right = b + static_cast<std::size_t>(c) * rows;
    for (std::size_t i = 0; i < rows; ++i) scale[c] = std::max(scale[c], std::abs(right[i]));
    if (!(scale[c] > 0)) scale[c] = 1;
    for (std::size_t i = 0; i < rows; ++i) y_[c * rows + i] = static_cast<float>(right[order_[i]] / scale[c]);
  }
  lower_.solve(y_.data(), count);
  for (int c = 0; c < count; ++c)
    for (std::size_t i = 0; i < rows; ++i) y_[c * rows + i] *= pivots_[i];
  lower_.solve_transposed(y_.data(), count);
  for (int c = 0; c < count; ++c)
    for (std::size_t i = 0; i < rows; ++i) x[c * rows + order_[i]] = scale[c] * static_cast<double>(y_[c * rows + i]);
}

std::size_t SingleCholesky::bytes() const {
  return lower_.bytes() + order_.size() * (2 * sizeof(float) + sizeof(int));
}

}  // namespace fsi
