#include "linear/amg/scalar_multigrid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "algebra/register_blocks.hpp"
#include "base/error.hpp"
#include "host/parallel_for.hpp"
#include "linear/amg/aggregation.hpp"
#include "linear/direct/dense_inverse.hpp"
#include "linear/krylov/power_iteration.hpp"

namespace fsi {

namespace {

/// Largest eigenvalue of D^-1 A.
double largest_eigenvalue_of(const CsrMatrix<double>& a, const std::vector<double>& diagonal) {
  return largest_eigenvalue(rough_vector(a.rows()), eigenvalue_iterations, [&](const auto& x, auto& y) {
    multiply(a, x, y);
    for (int i = 0; i < a.rows(); ++i) y[i] /= diagonal[i];
  });
}

constexpr std::size_t parallel_entries = 50000;  // of a matrix, from which a product wakes threads

/// A row of m vectors: its arithmetic, one number or a register.
template <int m>
struct RowOf {
  static constexpr int lanes = padded<m>;
  using Value = Register<m>;
  static Value load(const std::vector<float>& from, int row) {
    return fsi::load<m>(from.data() + static_cast<std::size_t>(row) * lanes);
  }
  static void store(Value value, std::vector<float>& to, int row) {
    fsi::store<m>(value, to.data() + static_cast<std::size_t>(row) * lanes);
  }
  /// Entries begin ... end - 1 of a matrix times x.
  static Value product(const CsrMatrix<float>& a, int begin, int end, const std::vector<float>& x) {
    Value sum{};
    for (int at = begin; at < end; ++at) sum += a.values[at] * load(x, a.indices[at]);
    return sum;
  }
};
template <>
struct RowOf<1> {
  static constexpr int lanes = 1;
  using Value = float;
  static Value load(const std::vector<float>& from, int row) { return from[row]; }
  static void store(Value value, std::vector<float>& to, int row) { to[row] = value; }
  static Value product(const CsrMatrix<float>& a, int begin, int end, const std::vector<float>& x) {
    return row_product(a, begin, end, x.data());
  }
};

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
  const double scale = omega / largest_eigenvalue_of(filtered, diagonal);

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
  assert(matrix.rows() == matrix.columns);
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
  if (inverse.empty()) throw ConvergenceError("the matrix of a multigrid is singular on the coarsest level", "");
  coarsest_inverse_.assign(inverse.begin(), inverse.end());
}

template <int m>
void ScalarMultigrid::cycle_each(const std::vector<float>& b, std::vector<float>& x) {
  assert(b.size() == x.size());
  cycle_from<m>(0, b, x);
}

template <int m>
void ScalarMultigrid::cycle_from(std::size_t depth, const std::vector<float>& b, std::vector<float>& x) {
  using Row = RowOf<m>;
  if (depth == levels_.size()) {
    std::fill(x.begin(), x.end(), 0.0f);
    for (int j = 0; j < coarsest_size_; ++j) {
      const float* column = coarsest_inverse_.data() + static_cast<std::size_t>(j) * coarsest_size_;
      const auto value = Row::load(b, j);
      for (int i = 0; i < coarsest_size_; ++i) Row::store(Row::load(x, i) + column[i] * value, x, i);
    }
    return;
  }
  Level& level = levels_[depth];
  const auto& a = level.matrix;
  const auto& chunks = level.chunks;
  level.residual.resize(static_cast<std::size_t>(a.rows()) * Row::lanes);
  level.coarse_residual.resize(static_cast<std::size_t>(level.restriction.rows()) * Row::lanes);
  level.coarse_correction.resize(level.coarse_residual.size());
  auto& r = level.residual;
  // (D + L) x = b
  chunks.forward([&](int row) {
    Row::store(
        (Row::load(b, row) - Row::product(a, chunks.first[row], chunks.diagonal[row], x)) * level.inverse_diagonal[row],
        x, row);
  });
  // b - A x = -(U x) - (couplings between chunks) x: half a product
  parallel_for(a.rows(), chunks.chunks() > 1, [&](int row) {
    Row::store(-Row::product(a, a.offsets[row], chunks.first[row], x) -
                   Row::product(a, chunks.diagonal[row] + 1, a.offsets[row + 1], x),
               r, row);
  });
  const auto& restriction = level.restriction;
#pragma omp parallel for schedule(static) if (restriction.nonzeros() > parallel_entries)
  for (int row = 0; row < restriction.rows(); ++row)
    Row::store(Row::product(restriction, restriction.offsets[row], restriction.offsets[row + 1], r),
               level.coarse_residual, row);
  cycle_from<m>(depth + 1, level.coarse_residual, level.coarse_correction);
  const auto& prolongation = level.prolongation;
#pragma omp parallel for schedule(static) if (prolongation.nonzeros() > parallel_entries)
  for (int row = 0; row < prolongation.rows(); ++row)
    Row::store(Row::load(x, row) + Row::product(prolongation, prolongation.offsets[row], prolongation.offsets[row + 1],
                                                level.coarse_correction),
               x, row);
  if (!post_smoothing_) return;
    // (D + U) e = b - A x, x += e; e takes the residual's place
#pragma omp parallel for schedule(static) if (a.nonzeros() > parallel_entries)
  for (int row = 0; row < a.rows(); ++row)
    Row::store(Row::load(b, row) - Row::product(a, a.offsets[row], a.offsets[row + 1], x), r, row);
  chunks.backward([&](int row) {
    const auto e = (Row::load(r, row) - Row::product(a, chunks.diagonal[row] + 1, chunks.last[row], r)) *
                   level.inverse_diagonal[row];
    Row::store(e, r, row);
    Row::store(Row::load(x, row) + e, x, row);
  });
}

template void ScalarMultigrid::cycle_each<1>(const std::vector<float>&, std::vector<float>&);
template void ScalarMultigrid::cycle_each<2>(const std::vector<float>&, std::vector<float>&);
template void ScalarMultigrid::cycle_each<3>(const std::vector<float>&, std::vector<float>&);

std::size_t ScalarMultigrid::bytes() const {
  std::size_t sum = coarsest_inverse_.size() * sizeof(float);
  for (const auto& l : levels_)
    sum += l.matrix.bytes() + l.prolongation.bytes() + l.restriction.bytes() + 7 * sizeof(float) * l.residual.size();
  return sum;
}

}  // namespace fsi
