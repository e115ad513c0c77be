#include "linear/amg/rigid_motion_multigrid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "algebra/block_products.hpp"
#include "base/error.hpp"
#include "host/parallel_for.hpp"
#include "linear/amg/aggregation.hpp"
#include "linear/amg/shared_rows.hpp"
#include "linear/direct/dense_inverse.hpp"
#include "linear/krylov/power_iteration.hpp"

namespace fsi {

namespace {

template <int n>
constexpr int modes_of = RigidMotionMultigrid<n>::modes;

template <int modes, int size>
struct Coarsened {
  BlockMatrix<size, modes> prolongation;
  BlockMatrix<modes, size> restriction;  ///< rows of copies, too
  BlockMatrix<modes, modes> matrix;
  ShareOfNumbers share;
  std::vector<double> space;  ///< the rigid motions on the coarse nodes: rows x modes
};

/// y += A x
template <int R, int C>
void add(const RegisterBlocks<R, C>& a, const std::vector<float>& from, std::vector<float>& to) {
#pragma omp parallel for schedule(static) if (a.columns.size() > 5000)
  for (int row = 0; row < a.rows(); ++row) {
    float* y = to.data() + static_cast<std::size_t>(row) * padded<R>;
    store<R>(load<R>(y) + a.row_product(row, from.data()), y);
  }
}

/// Translations and rotations on the finest nodes, `modes` numbers a row; zero in fixed components.
template <int n>
std::vector<double> rigid_motions(const std::vector<std::array<double, 3>>& points, const std::vector<char>& fixed) {
  constexpr int modes = modes_of<n>;
  std::vector<double> space(points.size() * n * modes, 0.0);
  std::array<double, 3> middle{};
  for (const auto& point : points)
    for (int k = 0; k < 3; ++k) middle[k] += point[k] / static_cast<double>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto entry = [&](int k, int mode) -> double& { return space[(i * n + k) * modes + mode]; };
    for (int k = 0; k < n; ++k) entry(k, k) = 1;
    for (int axis = 0; axis < 3 && modes > n; ++axis) {
      const int j = (axis + 1) % 3, k = (axis + 2) % 3;
      entry(j, 3 + axis) = middle[k] - points[i][k];
      entry(k, 3 + axis) = points[i][j] - middle[j];
    }
    for (int k = 0; k < n && !fixed.empty(); ++k)
      for (int mode = 0; mode < modes && fixed[i * n + k]; ++mode) entry(k, mode) = 0;
  }
  return space;
}

/// Frobenius norms of the blocks.
template <int size>
CsrMatrix<double> block_norms(const BlockMatrix<size, size>& a, int columns) {
  CsrMatrix<double> norms;
  norms.columns = columns;
  norms.offsets = a.graph->offsets;
  norms.indices = a.graph->columns;
  norms.values.resize(norms.indices.size());
  for (int at = 0; at < a.graph->blocks(); ++at) {
    double sum = 0;
    for (int i = 0; i < size * size; ++i) sum += a.block(at)[i] * a.block(at)[i];
    norms.values[at] = std::sqrt(sum);
  }
  return norms;
}

/// T: the rigid motions on each aggregate, made orthonormal by the modified Gram-Schmidt process, twice. Those that
/// depend on others stay zero. `space` becomes the factor: the same motions on the coarse nodes.
template <int modes, int size>
BlockMatrix<size, modes> tentative_prolongation(const std::vector<int>& aggregate, int count,
                                                std::vector<double>& space) {
  const int nodes = static_cast<int>(aggregate.size());
  auto graph = std::make_shared<NodeGraph>();
  for (int i = 0; i <= nodes; ++i) graph->offsets.push_back(i);
  graph->columns = aggregate;
  BlockMatrix<size, modes> t(graph);
  t.values = space;
  space.assign(static_cast<std::size_t>(count) * modes * modes, 0.0);
  std::vector<int> first(static_cast<std::size_t>(count) + 1, 0), members(nodes);
  for (int a : aggregate) ++first[a + 1];
  for (int a = 0; a < count; ++a) first[a + 1] += first[a];
  std::vector<int> next(first.begin(), first.end() - 1);
  for (int i = 0; i < nodes; ++i) members[next[aggregate[i]]++] = i;
  for (int a = 0; a < count; ++a) {
    const auto for_rows = [&](auto visit) {
      for (int at = first[a]; at < first[a + 1]; ++at)
        for (int r = 0; r < size; ++r) visit(t.block(members[at]) + r * modes);
    };
    double* factor = space.data() + static_cast<std::size_t>(a) * modes * modes;
    for (int m = 0; m < modes; ++m) {
      double before = 0, after = 0;
      for_rows([&](const double* row) { before += row[m] * row[m]; });
      for (int pass = 0; pass < 2; ++pass)
        for (int k = 0; k < m; ++k) {
          double dot = 0;
          for_rows([&](const double* row) { dot += row[k] * row[m]; });
          for_rows([&](double* row) { row[m] -= dot * row[k]; });
          factor[k * modes + m] += dot;
        }
      for_rows([&](const double* row) { after += row[m] * row[m]; });
      const double length = after > 1e-8 * before ? std::sqrt(after) : 0;
      for_rows([&](double* row) { row[m] *= length > 0 ? 1 / length : 0; });
      factor[m * modes + m] = length;
    }
  }
  return t;
}

template <int R, int C>
SparseRows as_rows(const BlockMatrix<R, C>& a) {
  return {R * C, a.graph->offsets, a.graph->columns, a.values};
}

template <int R, int C>
BlockMatrix<R, C> as_blocks(SparseRows rows) {
  auto graph = std::make_shared<NodeGraph>();
  graph->offsets = std::move(rows.offsets);
  graph->columns = std::move(rows.columns);
  BlockMatrix<R, C> a;
  a.graph = std::move(graph);
  a.values = std::move(rows.values);
  return a;
}

/// The same block matrix with its columns by another share.
template <int R, int C>
void renumber(BlockMatrix<R, C>& a, const ShareOfNumbers& from, const ShareOfNumbers& to) {
  auto graph = std::make_shared<NodeGraph>(*a.graph);
  fsi::renumber(graph->columns, from, to);
  a.graph = std::move(graph);
}

/// P = (I - omega / lambda D^-1 A_F) T; A_F is A with weak couplings added to the diagonal blocks, D its diagonal
/// (its diagonal blocks in place of that cost a third more iterations).
/// \param coarse  of the tentative's columns; gets copies of those that P names
template <int modes, int size>
void smooth(const BlockMatrix<size, size>& a, const ShareOfNumbers& share, const std::vector<char>& strong,
            const BlockMatrix<size, modes>& tentative, double damping, ShareOfNumbers& coarse,
            BlockMatrix<size, modes>& p) {
  auto graph = std::make_shared<NodeGraph>();
  graph->offsets.push_back(0);
  BlockMatrix<size, size> filtered;  // D^-1 A_F
  filtered.values.reserve(a.values.size());
  for (int row = 0; row < a.graph->rows(); ++row) {
    const int begin = a.graph->offsets[row], end = a.graph->offsets[row + 1];
    double diagonal[size * size] = {};
    for (int at = begin; at < end; ++at)
      if (a.graph->columns[at] == row || !strong[at])
        for (int i = 0; i < size * size; ++i) diagonal[i] += a.block(at)[i];
    const double* own = a.block(a.graph->find(row, row));
    for (int i = 0; i < size * size; i += size + 1)
      // Weak couplings of the opposite sign, as large as the diagonal, would leave nothing to divide by.
      if (diagonal[i] * own[i] < 0.1 * own[i] * own[i]) diagonal[i] = own[i];
    for (int at = begin; at < end; ++at) {
      if (!strong[at]) continue;
      const double* block = a.graph->columns[at] == row ? diagonal : a.block(at);
      graph->columns.push_back(a.graph->columns[at]);
      for (int i = 0; i < size * size; ++i) filtered.values.push_back(block[i] / diagonal[i / size * (size + 1)]);
    }
    graph->offsets.push_back(static_cast<int>(graph->columns.size()));
  }
  filtered.graph = std::move(graph);
  std::vector<double> with_copies(static_cast<std::size_t>(share.items()) * size, 0.0);  // own rows and columns alone
  const double scale = damping / share.processes->largest(
                                     largest_eigenvalue(rough_vector(static_cast<std::size_t>(a.graph->rows()) * size),
                                                        eigenvalue_iterations, [&](const auto& x, auto& y) {
                                                          std::copy(x.begin(), x.end(), with_copies.begin());
                                                          multiply(filtered, with_copies, y);
                                                        }));
  const auto all = as_blocks<size, modes>(with_rows_of_copies(as_rows(tentative), share, coarse));
  p = block_product(filtered, all, coarse.items());
  for (double& value : p.values) value *= -scale;
  for (int row = 0; row < a.graph->rows(); ++row) {
    double* to = p.block(p.graph->find(row, tentative.graph->columns[row]));
    for (int i = 0; i < size * modes; ++i) to[i] += tentative.block(row)[i];
  }
}

/// The next level; none where nothing couples.
template <int modes, int size>
std::optional<Coarsened<modes, size>> coarsened(const BlockMatrix<size, size>& a, const ShareOfNumbers& share,
                                                const std::vector<double>& space, double& threshold,
                                                double first_threshold, double damping) {
  const Communicator& processes = *share.processes;
  const auto norms = block_norms(a, share.items());
  auto diagonal = diagonal_of(norms);
  diagonal.resize(share.items());
  share.exchange.update(diagonal);
  const auto whole = static_cast<double>(processes.sum(std::int64_t{norms.rows()}));
  for (; threshold > 1e-4 * first_threshold; threshold *= 0.5) {
    const auto strong = strong_entries(norms, diagonal, threshold);
    auto within = strong;  // an aggregate is one process's
    for (std::size_t at = 0; at < within.size(); ++at)
      if (norms.indices[at] >= norms.rows()) within[at] = 0;
    int count = 0;
    const auto aggregate = aggregates(norms, within, count);
    if (static_cast<double>(processes.sum(std::int64_t{count})) > 0.8 * whole)
      continue;  // hardly anything is strong: demand less
    threshold *= 0.5;
    Coarsened<modes, size> result;
    ShareOfNumbers& coarse = result.share = ShareOfNumbers(processes, count, {});
    result.space = space;
    const auto tentative = tentative_prolongation<modes, size>(aggregate, count, result.space);
    auto& p = result.prolongation;
    smooth(a, share, strong, tentative, damping, coarse, p);
    ShareOfNumbers before = coarse;
    const auto all = as_blocks<size, modes>(with_rows_of_copies(as_rows(p), share, coarse));
    renumber(p, before, coarse);
    const int columns = coarse.items();
    before = coarse;
    result.matrix = as_blocks<modes, modes>(
        sum_of_rows(as_rows(block_product(transposed(p, columns), block_product(a, all, columns), columns)), coarse));
    renumber(p, before, coarse);
    result.restriction = transposed(p, coarse.items());
    // Rigid motions that depend on others within an aggregate have left empty rows: a one keeps them at zero.
    for (int i = 0; i < count; ++i) {
      double* block = result.matrix.block(result.matrix.graph->find(i, i));
      for (int k = 0; k < modes; ++k)
        if (block[k * modes + k] == 0) block[k * modes + k] = 1;
    }
    return result;
  }
  return std::nullopt;
}

/// Inverses of the diagonal blocks, padded.
/// \throws ConvergenceError by all processes when one has a singular block
template <int modes>
std::vector<float> inverse_diagonal(const BlockMatrix<modes, modes>& a, const Communicator& processes) {
  bool singular = false;
  std::vector<float> inverses(static_cast<std::size_t>(a.graph->rows()) * modes * padded<modes>, 0.0f);
  std::vector<double> block(modes * modes);
  for (int row = 0; row < a.graph->rows(); ++row) {
    const double* from = a.block(a.graph->find(row, row));
    block.assign(from, from + modes * modes);
    const auto inverse = dense_inverse(block, modes);
    singular = singular || inverse.empty();
    if (singular) break;
    float* to = inverses.data() + static_cast<std::size_t>(row) * modes * padded<modes>;
    for (int c = 0; c < modes; ++c)
      for (int r = 0; r < modes; ++r) to[c * padded<modes> + r] = static_cast<float>(inverse[r * modes + c]);
  }
  if (processes.any(singular))
    throw ConvergenceError("the wall's stiffness has a singular block on a coarse level", "");
  return inverses;
}

}  // namespace

template <int n>
void RigidMotionMultigrid<n>::set_up(const BlockMatrix<n, n>& finest, const ShareOfNumbers& share_of_finest,
                                     const std::vector<std::array<double, 3>>& points, const Options& options,
                                     const std::vector<char>& fixed) {
  assert(static_cast<int>(points.size()) == finest.graph->rows());
  assert(fixed.empty() || fixed.size() == points.size() * n);
  assert(share_of_finest.own == finest.graph->rows());
  levels_.clear();
  coarsest_inverse_.clear();
  processes_ = share_of_finest.processes;
  post_smoothing_ = options.post_smoothing;
  double threshold = options.threshold;
  auto first = coarsened<modes>(finest, share_of_finest, rigid_motions<n>(points, fixed), threshold, options.threshold,
                                options.damping);
  coarsens_ = first.has_value();
  if (!first) return;
  restriction_ = RegisterBlocks<modes, n>(first->restriction);
  prolongation_ = RegisterBlocks<n, modes>(first->prolongation);
  BlockMatrix<modes, modes> a = std::move(first->matrix);
  ShareOfNumbers share = std::move(first->share);
  std::vector<double> space = std::move(first->space);
  while (processes_->sum(std::int64_t{a.graph->rows()}) > options.coarsest_nodes &&
         static_cast<int>(levels_.size()) < options.levels) {
    auto next = coarsened<modes>(a, share, space, threshold, options.threshold, options.damping);
    if (!next) break;
    Level level;
    level.matrix = RegisterBlocks<modes, modes>(a);
    level.prolongation = RegisterBlocks<modes, modes>(next->prolongation);
    level.restriction = RegisterBlocks<modes, modes>(next->restriction);
    level.chunks = SweepChunks(a.graph->offsets, a.graph->columns, SweepChunks::count_of_each(processes_->size()));
    level.inverse_diagonal = inverse_diagonal(a, *processes_);
    const std::size_t size = static_cast<std::size_t>(a.graph->rows()) * lanes;
    level.residual.assign(size, 0.0f);
    for (auto* v : {&level.b, &level.x}) v->assign(static_cast<std::size_t>(share.items()) * lanes, 0.0f);
    level.share = std::exchange(share, std::move(next->share));
    levels_.push_back(std::move(level));
    a = std::move(next->matrix);
    space = std::move(next->space);
  }
  invert_coarsest(std::move(a), share);
  for (auto* v : {&coarsest_b_, &coarsest_x_}) v->assign(static_cast<std::size_t>(share.items()) * lanes, 0.0f);
  coarsest_share_ = std::move(share);
}

template <int n>
void RigidMotionMultigrid<n>::correct(const std::vector<float>& residual, std::vector<float>& velocity) {
  if (!coarsens_) return;
  restriction_.multiply(residual, b(0));
  share(0).exchange.add_from_copies(b(0), lanes);
  cycle(0);
  share(0).exchange.update(x(0), lanes);
  add(prolongation_, x(0), velocity);
}

template <int n>
std::size_t RigidMotionMultigrid<n>::bytes() const {
  std::size_t sum = restriction_.bytes() + prolongation_.bytes() + coarsest_inverse_.size() * sizeof(float);
  for (const auto& l : levels_)
    sum += l.matrix.bytes() + l.prolongation.bytes() + l.restriction.bytes() +
           (l.inverse_diagonal.size() + 3 * l.x.size()) * sizeof(float);
  return sum;
}

template <int n>
void RigidMotionMultigrid<n>::invert_coarsest(BlockMatrix<modes, modes> matrix, const ShareOfNumbers& share) {
  const auto all =
      gather_rows({modes * modes, matrix.graph->offsets, matrix.graph->columns, std::move(matrix.values)}, share);
  const std::size_t size = static_cast<std::size_t>(all.rows()) * modes;
  std::vector<double> dense(size * size, 0.0);  // column-major
  for (int row = 0; row < all.rows(); ++row)
    for (int at = all.offsets[row]; at < all.offsets[row + 1]; ++at)
      for (int r = 0; r < modes; ++r)
        for (int c = 0; c < modes; ++c)
          dense[(static_cast<std::size_t>(all.columns[at]) * modes + c) * size + row * modes + r] =
              all.values[static_cast<std::size_t>(at) * modes * modes + r * modes + c];
  const auto inverse = dense_inverse(dense, static_cast<int>(size));
  if (inverse.empty()) throw ConvergenceError("the wall's stiffness is singular on the coarsest level", "");
  const std::size_t own = static_cast<std::size_t>(share.own) * modes, first = share.first * modes;
  coarsest_inverse_.resize(own * size);
  for (std::size_t column = 0; column < size; ++column)
    for (std::size_t row = 0; row < own; ++row)
      coarsest_inverse_[column * own + row] = static_cast<float>(inverse[column * size + first + row]);
  coarsest_counts_.clear();
  for (const std::int64_t rows : processes_->gather(std::int64_t{share.own}))
    coarsest_counts_.push_back(static_cast<int>(rows) * lanes);
  coarsest_right_.resize(static_cast<std::size_t>(all.rows()) * lanes);
}

template <int n>
void RigidMotionMultigrid<n>::solve_coarsest() {
  processes_->gather(coarsest_b_.data(), coarsest_counts_, coarsest_right_.data());
  const std::size_t own = static_cast<std::size_t>(coarsest_share_.own) * modes,
                    size = coarsest_right_.size() / lanes * modes;
  dense_x_.assign(own, 0.0f);
  for (std::size_t j = 0; j < size; ++j) {
    const float* column = coarsest_inverse_.data() + j * own;
    const float value = coarsest_right_[j / modes * lanes + j % modes];
    for (std::size_t i = 0; i < own; ++i) dense_x_[i] += column[i] * value;
  }
  for (std::size_t i = 0; i < own; ++i) coarsest_x_[i / modes * lanes + i % modes] = dense_x_[i];
}

template <int n>
void RigidMotionMultigrid<n>::cycle(std::size_t depth) {
  if (depth == levels_.size()) {
    solve_coarsest();
    return;
  }
  Level& level = levels_[depth];
  const auto& a = level.matrix;
  const auto& chunks = level.chunks;
  const auto place = [](std::vector<float>& v, int row) { return v.data() + static_cast<std::size_t>(row) * lanes; };
  const auto solve_diagonal = [&](int row, Register<modes> r) {
    float numbers[lanes];
    store<modes>(r, numbers);
    return block_times<modes, modes>(level.inverse_diagonal.data() + static_cast<std::size_t>(row) * modes * lanes,
                                     numbers);
  };
  // (D + L) x = b
  chunks.forward([&](int row) {
    const Register<modes> before = a.product(chunks.first[row], chunks.diagonal[row], level.x.data());
    store<modes>(solve_diagonal(row, load<modes>(place(level.b, row)) - before), place(level.x, row));
  });
  level.share.exchange.update(level.x, lanes);
  // b - A x = -(U x) - (couplings between chunks, and with copies) x: half a product
  parallel_for(a.rows(), chunks.chunks() > 1, [&](int row) {
    store<modes>(-a.product(a.offsets[row], chunks.first[row], level.x.data()) -
                     a.product(chunks.diagonal[row] + 1, a.offsets[row + 1], level.x.data()),
                 place(level.residual, row));
  });
  level.restriction.multiply(level.residual, b(depth + 1));
  share(depth + 1).exchange.add_from_copies(b(depth + 1), lanes);
  cycle(depth + 1);
  share(depth + 1).exchange.update(x(depth + 1), lanes);
  add(level.prolongation, x(depth + 1), level.x);
  if (!post_smoothing_) return;
  level.share.exchange.update(level.x, lanes);
  // (D + U) e = b - A x, x += e; e takes the residual's place
  parallel_for(a.rows(), chunks.chunks() > 1, [&](int row) {
    store<modes>(load<modes>(place(level.b, row)) - a.row_product(row, level.x.data()), place(level.residual, row));
  });
  chunks.backward([&](int row) {
    const Register<modes> after = a.product(chunks.diagonal[row] + 1, chunks.last[row], level.residual.data());
    store<modes>(solve_diagonal(row, load<modes>(place(level.residual, row)) - after), place(level.residual, row));
    store<modes>(load<modes>(place(level.x, row)) + load<modes>(place(level.residual, row)), place(level.x, row));
  });
}

template class RigidMotionMultigrid<2>;
template class RigidMotionMultigrid<3>;

}  // namespace fsi
