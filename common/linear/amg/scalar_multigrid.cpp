#include "linear/amg/scalar_multigrid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "algebra/register_blocks.hpp"
#include "base/error.hpp"
#include "host/parallel_for.hpp"
#include "linear/amg/aggregation.hpp"
#include "linear/amg/shared_rows.hpp"
#include "linear/direct/dense_inverse.hpp"
#include "linear/krylov/power_iteration.hpp"

namespace fsi {

namespace {

/// Largest eigenvalue of D^-1 A among own rows and columns.
double largest_eigenvalue_of(const CsrMatrix<double>& a, const std::vector<double>& diagonal) {
  std::vector<double> with_copies(a.columns, 0.0);
  return largest_eigenvalue(rough_vector(a.rows()), eigenvalue_iterations, [&](const auto& x, auto& y) {
    std::copy(x.begin(), x.end(), with_copies.begin());
    multiply(a, with_copies, y);
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
/// \param share   of a's columns
/// \param coarse  of the aggregates: own ones; gets copies of those that P names
CsrMatrix<double> smoothed_prolongation(const CsrMatrix<double>& a, const ShareOfNumbers& share,
                                        const std::vector<char>& strong, const std::vector<int>& aggregate,
                                        double omega, ShareOfNumbers& coarse) {
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
    // Weak couplings of the opposite sign, as large as the diagonal, would leave nothing to divide by.
    if (diagonal[row] * original[row] < 0.1 * original[row] * original[row]) diagonal[row] = original[row];
  const double scale = omega / share.processes->largest(largest_eigenvalue_of(filtered, diagonal));

  SparseRows tentative;
  tentative.columns = aggregate;
  tentative.values.assign(aggregate.size(), 1.0);
  for (int row = 0; row < a.rows(); ++row) tentative.offsets.push_back(row + 1);
  auto all = with_rows_of_copies(std::move(tentative), share, coarse);
  CsrMatrix<double> p =
      product(filtered, {coarse.items(), std::move(all.offsets), std::move(all.columns), std::move(all.values)});
  for (int row = 0; row < a.rows(); ++row)
    for (int at = p.offsets[row]; at < p.offsets[row + 1]; ++at) {
      p.values[at] *= -scale / diagonal[row];
      if (p.indices[at] == aggregate[row]) p.values[at] += 1;
    }
  return p;
}

/// P^T A P.
/// \param p       own rows; its columns are renumbered
/// \param coarse  of p's columns; gets copies of those that the product names
CsrMatrix<double> galerkin_product(const CsrMatrix<double>& a, const ShareOfNumbers& share, CsrMatrix<double>& p,
                                   ShareOfNumbers& coarse) {
  ShareOfNumbers before = coarse;
  auto all = with_rows_of_copies({1, p.offsets, p.indices, p.values}, share, coarse);
  renumber(p.indices, before, coarse);
  p.columns = coarse.items();
  auto c = product(transposed(p),
                   product(a, {p.columns, std::move(all.offsets), std::move(all.columns), std::move(all.values)}));
  before = coarse;
  auto sum = sum_of_rows({1, std::move(c.offsets), std::move(c.indices), std::move(c.values)}, coarse);
  renumber(p.indices, before, coarse);
  p.columns = coarse.items();
  return {coarse.items(), std::move(sum.offsets), std::move(sum.columns), std::move(sum.values)};
}

}  // namespace

void ScalarMultigrid::set_up(const CsrMatrix<double>& matrix, const ShareOfNumbers& share_of_matrix,
                             const Options& options) {
  assert(matrix.rows() == share_of_matrix.own && matrix.columns == share_of_matrix.items());
  levels_.clear();
  processes_ = share_of_matrix.processes;
  post_smoothing_ = options.post_smoothing;
  CsrMatrix<double> a = matrix;
  ShareOfNumbers share = share_of_matrix;
  double threshold = options.threshold;
  std::size_t entries = 0;
  while (levels() < options.levels) {
    const std::int64_t whole = processes_->sum(std::int64_t{a.rows()});
    if (whole <= options.coarsest_size) break;
    auto diagonal = diagonal_of(a);
    diagonal.resize(share.items());
    share.exchange.update(diagonal);
    const auto strong = strong_entries(a, diagonal, threshold);
    auto within = strong;  // an aggregate is one process's
    for (std::size_t at = 0; at < within.size(); ++at)
      if (a.indices[at] >= a.rows()) within[at] = 0;
    diagonal.resize(a.rows());
    int count = 0;
    const auto aggregate = aggregates(a, within, count);
    threshold *= 0.5;
    const bool stuck = static_cast<double>(processes_->sum(std::int64_t{count})) > 0.8 * static_cast<double>(whole);
    if (stuck && threshold > 1e-3 * options.threshold) continue;  // hardly anything is strong: demand less
    Level level;
    level.matrix = converted<float>(a);
    level.chunks = SweepChunks(a.offsets, a.indices, SweepChunks::count_of_each(processes_->size()));
    for (double d : diagonal) level.inverse_diagonal.push_back(static_cast<float>(1 / d));
    level.residual.resize(a.rows());
    entries += a.nonzeros();
    CsrMatrix<double> p;
    ShareOfNumbers coarse(*processes_, stuck ? 0 : count, {});
    if (stuck) {  // nothing couples: the smoother alone solves it
      p.offsets.assign(static_cast<std::size_t>(a.rows()) + 1, 0);
      a = CsrMatrix<double>();
    } else {
      p = smoothed_prolongation(a, share, strong, aggregate, options.damping, coarse);
      a = galerkin_product(a, share, p, coarse);
    }
    level.prolongation = converted<float>(p);
    level.restriction = converted<float>(transposed(p));
    level.share = std::exchange(share, std::move(coarse));
    levels_.push_back(std::move(level));
  }
  coarsest_share_ = share;
  double sums[2] = {static_cast<double>(entries + a.nonzeros()), static_cast<double>(matrix.nonzeros())};
  processes_->sum(sums, 2);
  complexity_ = sums[1] > 0 ? sums[0] / sums[1] : 0;
  invert_coarsest(std::move(a), share);
}

void ScalarMultigrid::invert_coarsest(CsrMatrix<double> matrix, const ShareOfNumbers& share) {
  const int own = matrix.rows();
  const auto whole =
      gather_rows({1, std::move(matrix.offsets), std::move(matrix.indices), std::move(matrix.values)}, share);
  const int size = whole.rows();
  coarsest_inverse_.clear();
  coarsest_counts_.clear();
  for (const std::int64_t rows : processes_->gather(std::int64_t{own}))
    coarsest_counts_.push_back(static_cast<int>(rows));
  if (size == 0) return;
  std::vector<double> dense(static_cast<std::size_t>(size) * size, 0.0);  // column-major
  for (int row = 0; row < size; ++row)
    for (int at = whole.offsets[row]; at < whole.offsets[row + 1]; ++at)
      dense[static_cast<std::size_t>(whole.columns[at]) * size + row] = whole.values[at];
  const auto inverse = dense_inverse(dense, size);
  if (inverse.empty()) throw ConvergenceError("the matrix of a multigrid is singular on the coarsest level", "");
  coarsest_inverse_.resize(static_cast<std::size_t>(own) * size);
  for (int column = 0; column < size; ++column)
    for (int row = 0; row < own; ++row)
      coarsest_inverse_[static_cast<std::size_t>(column) * own + row] =
          static_cast<float>(inverse[static_cast<std::size_t>(column) * size + share.first + row]);
}

template <int m>
void ScalarMultigrid::cycle_each(const std::vector<float>& b, std::vector<float>& x) {
  assert(b.size() == x.size());
  if (levels_.empty() || levels_.front().share.copies.empty()) return cycle_from<m>(0, b, x);
  finest_.resize(static_cast<std::size_t>(levels_.front().share.items()) * RowOf<m>::lanes);
  cycle_from<m>(0, b, finest_);
  std::copy_n(finest_.begin(), x.size(), x.begin());
}

template <int m>
void ScalarMultigrid::solve_coarsest(const std::vector<float>& b, std::vector<float>& x) {
  using Row = RowOf<m>;
  const int own = coarsest_counts_[processes_->rank()];
  std::vector<int> counts = coarsest_counts_;
  int size = 0;
  for (int& count : counts) {
    size += count;
    count *= Row::lanes;
  }
  coarsest_right_.resize(static_cast<std::size_t>(size) * Row::lanes);
  processes_->gather(b.data(), counts, coarsest_right_.data());
  std::fill(x.begin(), x.end(), 0.0f);
  for (int j = 0; j < size; ++j) {
    const float* column = coarsest_inverse_.data() + static_cast<std::size_t>(j) * own;
    const auto value = Row::load(coarsest_right_, j);
    for (int i = 0; i < own; ++i) Row::store(Row::load(x, i) + column[i] * value, x, i);
  }
}

template <int m>
void ScalarMultigrid::cycle_from(std::size_t depth, const std::vector<float>& b, std::vector<float>& x) {
  using Row = RowOf<m>;
  if (depth == levels_.size()) return solve_coarsest<m>(b, x);
  Level& level = levels_[depth];
  const auto& a = level.matrix;
  const auto& chunks = level.chunks;
  level.residual.resize(static_cast<std::size_t>(a.rows()) * Row::lanes);
  level.coarse_residual.resize(static_cast<std::size_t>(level.restriction.rows()) * Row::lanes);
  const auto& among_coarse = share(depth + 1).exchange;
  level.coarse_correction.resize(level.coarse_residual.size());
  auto& r = level.residual;
  // (D + L) x = b
  chunks.forward([&](int row) {
    Row::store(
        (Row::load(b, row) - Row::product(a, chunks.first[row], chunks.diagonal[row], x)) * level.inverse_diagonal[row],
        x, row);
  });
  level.share.exchange.update(x, Row::lanes);
  // b - A x = -(U x) - (couplings between chunks, and with copies) x: half a product
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
  among_coarse.add_from_copies(level.coarse_residual, Row::lanes);
  cycle_from<m>(depth + 1, level.coarse_residual, level.coarse_correction);
  among_coarse.update(level.coarse_correction, Row::lanes);
  const auto& prolongation = level.prolongation;
#pragma omp parallel for schedule(static) if (prolongation.nonzeros() > parallel_entries)
  for (int row = 0; row < prolongation.rows(); ++row)
    Row::store(Row::load(x, row) + Row::product(prolongation, prolongation.offsets[row], prolongation.offsets[row + 1],
                                                level.coarse_correction),
               x, row);
  if (!post_smoothing_) return;
  level.share.exchange.update(x, Row::lanes);
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
