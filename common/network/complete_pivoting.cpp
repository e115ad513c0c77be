#include "network/complete_pivoting.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

namespace fsi {

namespace {

constexpr double zero_pivot = 1e-12;  // of scaled entries: smaller ones are zero

double over(double largest) {
  return largest > 0 ? 1 / largest : 1;
}

}  // namespace

CompletePivoting::CompletePivoting(std::vector<double> matrix, std::size_t size, const std::vector<bool>& last)
    : matrix_(std::move(matrix)),
      size_(size),
      row_scales_(size, 1.0),
      column_scales_(size, 1.0),
      rows_(size),
      columns_(size) {
  assert(matrix_.size() == size * size && (last.empty() || last.size() == size));
  std::iota(rows_.begin(), rows_.end(), std::size_t{0});
  std::iota(columns_.begin(), columns_.end(), std::size_t{0});
  for (std::size_t i = 0; i < size; ++i) {
    double largest = 0;
    for (std::size_t j = 0; j < size; ++j) largest = std::max(largest, std::abs(at(i, j)));
    row_scales_[i] = over(largest);
    for (std::size_t j = 0; j < size; ++j) at(i, j) *= row_scales_[i];
  }
  for (std::size_t j = 0; j < size; ++j) {
    double largest = 0;
    for (std::size_t i = 0; i < size; ++i) largest = std::max(largest, std::abs(at(i, j)));
    column_scales_[j] = over(largest);
    for (std::size_t i = 0; i < size; ++i) at(i, j) *= column_scales_[j];
  }
  for (; rank_ < size; ++rank_) {
    std::size_t row = rank_, column = rank_;
    double largest = 0;
    for (const bool of_last : {false, true}) {
      for (std::size_t i = rank_; i < size; ++i)
        for (std::size_t j = rank_; j < size; ++j)
          if ((!last.empty() && last[columns_[j]]) == of_last && std::abs(at(i, j)) > largest) {
            largest = std::abs(at(i, j));
            row = i;
            column = j;
          }
      if (largest > zero_pivot) break;
    }
    if (!(largest > zero_pivot)) break;
    std::swap(rows_[rank_], rows_[row]);
    std::swap(columns_[rank_], columns_[column]);
    for (std::size_t j = 0; j < size; ++j) std::swap(at(rank_, j), at(row, j));
    for (std::size_t i = 0; i < size; ++i) std::swap(at(i, rank_), at(i, column));
    for (std::size_t i = rank_ + 1; i < size; ++i) {
      const double factor = at(i, rank_) /= at(rank_, rank_);
      for (std::size_t j = rank_ + 1; factor != 0 && j < size; ++j) at(i, j) -= factor * at(rank_, j);
    }
  }
}

std::vector<std::size_t> CompletePivoting::open_columns() const {
  return {columns_.begin() + static_cast<std::ptrdiff_t>(rank_), columns_.end()};
}

double CompletePivoting::solve(const std::vector<double>& right, std::vector<double>& x) const {
  std::vector<double> b(size_);
  for (std::size_t i = 0; i < size_; ++i) b[i] = row_scales_[rows_[i]] * right[rows_[i]];
  for (std::size_t i = 0; i < size_; ++i)
    for (std::size_t j = 0; j < std::min(i, rank_); ++j) b[i] -= at(i, j) * b[j];
  double unsolved = 0;
  for (std::size_t i = rank_; i < size_; ++i) unsolved = std::max(unsolved, std::abs(b[i]));
  x.assign(size_, 0.0);
  for (std::size_t i = rank_; i-- > 0;) {
    for (std::size_t j = i + 1; j < rank_; ++j) b[i] -= at(i, j) * b[j];
    b[i] /= at(i, i);
  }
  for (std::size_t i = 0; i < rank_; ++i) x[columns_[i]] = column_scales_[columns_[i]] * b[i];
  return unsolved;
}

}  // namespace fsi
