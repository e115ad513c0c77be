#include "condensed_solver/scalar_multigrid.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "condensed_solver/aggregation.hpp"
#include "condensed_solver/dense_inverse.hpp"

namespace fsi {

namespace {

/// Largest eigenvalue of D^-1 A, to a few percent, by power iteration from a fixed rough vector.
double largest_eigenvalue(const CsrMatrix<double>& a, const std::vector<double>& diagonal) {
  std::vector<double> x(a.rows()), y(a.rows());
  for (int i = 0; i < a.rows(); ++i) x[i] = rough_number(i);
  double eigenvalue = 1;
  for (int k = 0; k < 12; ++k) {
    multiply(a, x, y);
    double sum = 0;
    for (int i = 0; i < a.rows(); ++i) {
      y[i] /= diagonal[i];
      sum += y[i] * y[i];
    }
    eigenvalue = std::sqrt(sum);
    for (int i = 0; i < a.rows(); ++i) x[i] = y[i] / eigenvalue;
  }
  return eigenvalue;
}

/// P = (I - omega / lambda D^-1 A_F) T; A_F is A with weak couplings added to its diagonal, T the aggregates'
/// indicator.
CsrMatrix<double> smoothed_prolongation(const CsrMatrix<double>& a, const std::vector<char>& strong,
                                        const std::vector<int>& aggregate, int count, double omega) {
  CsrMatrix<double> filtered;
  filtered.columns = a.columns;
  for (int row = 0; row < a.rows(); ++row) {
    double weak = 0;
    int diagonal_at = -1;
    for (int at = a.offsets[row]; at < a.offsets[row + 1]; ++at) {
      if (!strong[at]) {
        weak += a.values[at];
        continue;
      }
      if (a.indices[at] == row) diagonal_at = static_cast<int>(filtered.indices.size());
      filtered.indices.push_back(a.indices[at]);
      filtered.values.push_back(a.values[at]);
    }
    filtered.values[diagonal_at] += weak;
    filtered.offsets.push_back(static_cast<int>(filtered.indices.size()));
  }
  auto diagonal = diagonal_of(filtered);
  const auto original = diagonal_of(a);
  for (int row = 0; row < a.rows(); ++row)
    // Weak couplings of the diagonal's own sign and size would leave nothing to divide by.
    if (diagonal[row] * original[row] < 0.1 * original[row] * original[row]) diagonal[row] = original[row];
  const double scale = omega / largest_eigenvalue(filtered, diagonal);

  CsrMatrix<double> tentative;
  tentative.columns = count;
  tentative.indices = aggregate;
  tentative.values.assign(aggregate.size(), 1.0);
  for (int row = 0; row < a.rows(); ++row) tentative.offsets.push_back(row + 1);
  CsrMatrix<double> p = product(filtered, tentative);
  for (int row = 0; row < a.rows(); ++row)
    for (int at = p.offsets[row]; at < p.offsets[row + 1]; ++at) {
      p.values[at] *= -scale / diagonal[row];
      if (p.indices[at] == aggregate[row]) p.values[at] += 1;
    }
  return p;
}

}  // namespace

void ScalarMultigrid::set_up(const CsrMatrix<double>& matrix, const Options& options) {
  levels_.clear();
  post_smoothing_ = options.post_smoothing;
  CsrMatrix<double> a = matrix;
  double threshold = options.threshold;
  std::size_t entries = 0;
  while (a.rows() > options.coarsest_size && levels() < options.levels) {
    const auto diagonal = diagonal_of(a);
    const auto strong = strong_entries(a, diagonal, threshold);
    int count = 0;
    const auto aggregate = aggregates(a, strong, count);
    threshold *= 0.5;
    const bool stuck = count > 0.8 * a.rows();
    if (stuck && threshold > 1e-3 * options.threshold) continue;  // hardly anything is strong: demand less
    CsrMatrix<double> p;
    if (stuck) {  // nothing couples: the smoother alone solves it
      count = 0;
      p.offsets.assign(static_cast<std::size_t>(a.rows()) + 1, 0);
    } else {
      p = smoothed_prolongation(a, strong, aggregate, count, options.damping);
    }
    const auto r = transposed(p);
    Level level;
    level.matrix = converted<float>(a);
    level.prolongation = converted<float>(p);
    level.restriction = converted<float>(r);
    level.chunks = SweepChunks(a.offsets, a.indices);
    for (double d : diagonal) level.inverse_diagonal.push_back(static_cast<float>(1 / d));
    level.residual.resize(a.rows());
    level.coarse_residual.resize(count);
    level.coarse_correction.resize(count);
    entries += a.nonzeros();
    levels_.push_back(std::move(level));
    a = product(r, product(a, p));
  }
  entries += a.nonzeros();
  complexity_ = matrix.nonzeros() > 0 ? static_cast<double>(entries) / static_cast<double>(matrix.nonzeros()) : 0;
  invert_coarsest(a);
}

void ScalarMultigrid::invert_coarsest(const CsrMatrix<double>& matrix) {
  coarsest_size_ = matrix.rows();
  coarsest_inverse_.clear();
  if (coarsest_size_ == 0) return;
  const std::size_t size = coarsest_size_;
  std::vector<double> dense(size * size, 0.0);  // column-major
  for (int row = 0; row < matrix.rows(); ++row)
    for (int at = matrix.offsets[row]; at < matrix.offsets[row + 1]; ++at)
      dense[matrix.indices[at] * size + row] = matrix.values[at];
  const auto inverse = dense_inverse(dense, coarsest_size_);
  if (inverse.empty()) throw ConvergenceError("the pressure matrix is singular on the coarsest level", "");
  coarsest_inverse_.assign(inverse.begin(), inverse.end());
}

void ScalarMultigrid::cycle(std::size_t depth, const std::vector<float>& b, std::vector<float>& x) {
  if (depth == levels_.size()) {
    std::fill(x.begin(), x.end(), 0.0f);
    for (int j = 0; j < coarsest_size_; ++j) {
      const float* column = coarsest_inverse_.data() + static_cast<std::size_t>(j) * coarsest_size_;
      for (int i = 0; i < coarsest_size_; ++i) x[i] += column[i] * b[j];
    }
    return;
  }
  Level& level = levels_[depth];
  const auto& a = level.matrix;
  const auto& chunks = level.chunks;
  // (D + L) x = b
#pragma omp parallel for schedule(static) if (chunks.chunks() > 1)
  for (int c = 0; c < chunks.chunks(); ++c)
    for (int row = chunks.begin[c]; row < chunks.begin[c + 1]; ++row)
      x[row] =
          (b[row] - row_product(a, chunks.first[row], chunks.diagonal[row], x.data())) * level.inverse_diagonal[row];
  // b - A x = -(U x) - (couplings between chunks) x: half a product
  const float* values = x.data();
#pragma omp parallel for schedule(static) if (chunks.chunks() > 1)
  for (int row = 0; row < a.rows(); ++row)
    level.residual[row] = -row_product(a, a.offsets[row], chunks.first[row], values) -
                          row_product(a, chunks.diagonal[row] + 1, a.offsets[row + 1], values);
  multiply(level.restriction, level.residual, level.coarse_residual);
  cycle(depth + 1, level.coarse_residual, level.coarse_correction);
  multiply_add(level.prolongation, level.coarse_correction, x);
  if (!post_smoothing_) return;
  // (D + U) e = b - A x, x += e; e takes the residual's place
  residual(a, b, x, level.residual);
  auto& e = level.residual;
#pragma omp parallel for schedule(static) if (chunks.chunks() > 1)
  for (int c = 0; c < chunks.chunks(); ++c)
    for (int row = chunks.begin[c + 1] - 1; row >= chunks.begin[c]; --row) {
      e[row] =
          (e[row] - row_product(a, chunks.diagonal[row] + 1, chunks.last[row], e.data())) * level.inverse_diagonal[row];
      x[row] += e[row];
    }
}

std::size_t ScalarMultigrid::bytes() const {
  std::size_t sum = coarsest_inverse_.size() * sizeof(float);
  for (const auto& l : levels_)
    sum += l.matrix.bytes() + l.prolongation.bytes() + l.restriction.bytes() + 7 * sizeof(float) * l.residual.size();
  return sum;
}

}  // namespace fsi
