#include "linear/direct/single_factors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fsi {

namespace {

// What may be wrong of a known solution, and left of its right-hand side.
constexpr double largest_error = 1e-3;
constexpr int most_corrections = 20;

double serial_norm(const std::vector<double>& x) {
  double sum = 0;
  for (const double value : x) sum += value * value;
  return std::sqrt(sum);
}

/// The transpose by columns, which is the matrix by rows. Row numbers ascend in its columns, whatever they did before.
/// \param divisors  of the matrix's rows
template <class Number>
CompactColumns<Number> transposed(const SparseMatrix& a, const std::vector<double>& divisors) {
  CompactColumns<Number> t;
  t.offsets.assign(a.offsets.size(), 0);
  for (const std::int64_t row : a.rows) ++t.offsets[row + 1];
  for (std::int64_t i = 0; i < a.size(); ++i) t.offsets[i + 1] += t.offsets[i];
  t.rows.resize(a.rows.size());
  t.values.resize(a.values.size());
  std::vector<std::int64_t> next(t.offsets.begin(), t.offsets.end() - 1);
  for (std::int64_t column = 0; column < a.size(); ++column)
    for (std::int64_t k = a.offsets[column]; k < a.offsets[column + 1]; ++k) {
      const std::int64_t row = a.rows[k], to = next[row]++;
      t.rows[to] = static_cast<int>(column);
      t.values[to] = static_cast<Number>(a.values[k] / divisors[row]);
    }
  return t;
}

}  // namespace

SingleFactors::SingleFactors(const SparseMatrix& a, const std::vector<std::int64_t>& row_order,
                             const std::vector<std::int64_t>& column_order, const std::vector<double>& row_scale)
    : rows_(transposed<double>(a, std::vector<double>(row_order.size(), 1.0))),
      diagonal_(row_order.size(), 1.0F),
      row_order_(row_order.begin(), row_order.end()),
      column_order_(column_order.begin(), column_order.end()),
      y_(row_order.size()) {
  row_scale_.reserve(row_order.size());
  for (const std::int64_t row : row_order) row_scale_.push_back(row_scale[row]);
}

void SingleFactors::set_lower(const SparseMatrix& rows) {
  // By columns as they stand, these are of L^T.
  lower_ = PanelMatrix(transposed<float>(rows, std::vector<double>(y_.size(), 1.0)));
}

void SingleFactors::set_upper(const SparseMatrix& columns) {
  std::vector<double> pivots(y_.size(), 1.0);
  for (std::int64_t j = 0; j < columns.size(); ++j)
    for (std::int64_t k = columns.offsets[j]; k < columns.offsets[j + 1]; ++k)
      if (columns.rows[k] == j) pivots[j] = columns.values[k];
  upper_ = PanelMatrix(transposed<float>(columns, pivots));
  for (std::size_t i = 0; i < pivots.size(); ++i) diagonal_[i] = static_cast<float>(1 / pivots[i]);
}

void SingleFactors::solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) const {
  solve_once(b, x);
  const double demanded = tolerance * serial_norm(b);
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most_corrections; ++k) {
    compute_residual(b, x, residual_);
    const double left = serial_norm(residual_);
    if (k > 0 && !(left < last))  // no correction it was
      for (std::size_t i = 0; i < x.size(); ++i) x[i] -= correction_[i];
    if (!(left > demanded) || !(left < 0.5 * last)) return;  // the latter: all that is left is rounding
    last = left;
    solve_once(residual_, correction_);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += correction_[i];
  }
}

bool SingleFactors::serve() const {
  const std::vector<double> ones(y_.size(), 1.0), zero(y_.size(), 0.0);
  std::vector<double> b, x;
  compute_residual(zero, ones, b);  // -A times ones
  solve_once(b, x);
  compute_residual(b, x, residual_);
  double error = 0;
  for (const double value : x) error += (value + 1) * (value + 1);
  return serial_norm(residual_) <= largest_error * serial_norm(b) &&
         std::sqrt(error) <= largest_error * serial_norm(ones);
}

void SingleFactors::compute_residual(const std::vector<double>& b, const std::vector<double>& x,
                                     std::vector<double>& residual) const {
  residual.resize(b.size());
  for (int i = 0; i < rows_.size(); ++i) {
    double sum = 0;
    for (std::int64_t k = rows_.offsets[i]; k < rows_.offsets[i + 1]; ++k) sum += rows_.values[k] * x[rows_.rows[k]];
    residual[i] = b[i] - sum;
  }
}

void SingleFactors::solve_once(const std::vector<double>& b, std::vector<double>& x) const {
  double largest = 0;  // which right-hand sides are scaled by: the range of single precision is short
  for (std::size_t i = 0; i < y_.size(); ++i) largest = std::max(largest, std::abs(row_scale_[i] * b[row_order_[i]]));
  const double scale = largest > 0 ? largest : 1;
  for (std::size_t i = 0; i < y_.size(); ++i) y_[i] = static_cast<float>(row_scale_[i] / scale * b[row_order_[i]]);
  lower_.solve(y_.data());
  for (std::size_t i = 0; i < y_.size(); ++i) y_[i] *= diagonal_[i];
  upper_.solve_transposed(y_.data());
  x.resize(y_.size());
  for (std::size_t i = 0; i < y_.size(); ++i) x[column_order_[i]] = scale * static_cast<double>(y_[i]);
}

std::size_t SingleFactors::bytes() const {
  return lower_.bytes() + upper_.bytes() + rows_.values.size() * (sizeof(double) + sizeof(int)) +
         y_.size() * (2 * sizeof(float) + 2 * sizeof(int) + 4 * sizeof(double));
}

}  // namespace fsi
