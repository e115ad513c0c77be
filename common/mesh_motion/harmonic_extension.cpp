#include "mesh_motion/harmonic_extension.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <utility>

#include "algebra/block_products.hpp"
#include "algebra/register_blocks.hpp"
#include "fem/nodal_layout.hpp"
#include "host/parallel_for.hpp"
#include "linear/policy/solver_policy.hpp"

namespace fsi {

namespace {

// SharedCholesky keeps S^-1 and W dense; beyond these sizes the iteration serves instead. Chosen, not measured: all
// measured cases were smaller in both.
constexpr std::int64_t largest_separator = 1000;
constexpr double most_couplings = 8e6;

constexpr int chunk_rows = 2048;  // of a partial sum: fixed, so that sums do not depend on the number of threads

/// m scalar products of vectors that hold m numbers a row, over the first rows.
template <int m>
std::array<double, m> dots(int rows, const std::vector<double>& x, const std::vector<double>& y) {
  const int chunks = (rows + chunk_rows - 1) / chunk_rows;
  std::vector<std::array<double, m>> partial(chunks);
#pragma omp parallel for schedule(static) if (chunks > 4)
  for (int c = 0; c < chunks; ++c) {
    std::array<double, m> sum{};
    for (int row = c * chunk_rows; row < std::min(rows, (c + 1) * chunk_rows); ++row)
      for (int k = 0; k < m; ++k)
        sum[k] += x[static_cast<std::size_t>(row) * m + k] * y[static_cast<std::size_t>(row) * m + k];
    partial[c] = sum;
  }
  std::array<double, m> total{};
  for (const auto& sum : partial)
    for (int k = 0; k < m; ++k) total[k] += sum[k];
  return total;
}

/// y = A x for m vectors at once, m numbers a row.
template <int m>
void multiply_each(const CsrMatrix<double>& a, const std::vector<double>& x, std::vector<double>& y) {
  parallel_for(a.rows(), a.nonzeros() > 50000, [&](int row) {
    double sum[m] = {};
    for (int at = a.offsets[row]; at < a.offsets[row + 1]; ++at)
      for (int k = 0; k < m; ++k) sum[k] += a.values[at] * x[static_cast<std::size_t>(a.indices[at]) * m + k];
    for (int k = 0; k < m; ++k) y[static_cast<std::size_t>(row) * m + k] = sum[k];
  });
}

}  // namespace

template <int n>
HarmonicExtension<n>::HarmonicExtension(const BlockMatrix<1, n>& laplacian, std::vector<char> inner,
                                        const HarmonicExtensionOptions& options, const NodalFrames<n>* frames)
    : laplacian_(laplacian), inner_(std::move(inner)), options_(options), frames_(frames) {
  assert(inner_.size() == static_cast<std::size_t>(laplacian.graph->rows()) * n);
  values_.resize(inner_.size());
  rows_ = values_;
  find_couplings_to_given();
  build_groups();
}

template <int n>
HarmonicExtension<n>::HarmonicExtension(const BlockMatrix<1, n>& laplacian, std::vector<char> inner,
                                        const NodalFrames<n>* frames, const NodeShare& share,
                                        std::function<std::unique_ptr<MeshExtension<n>>()> rescue,
                                        const HarmonicExtensionOptions& options)
    : laplacian_(laplacian),
      inner_(std::move(inner)),
      options_(options),
      frames_(frames),
      nodes_(&share),
      make_rescue_(std::move(rescue)) {
  assert(!mixes(frames));
  values_.resize(inner_.size());
  rows_ = values_;
  for (std::size_t i = 0; i < inner_.size(); ++i) values_[i] = inner_[i] ? 1 : 0;
  update_ghosts(values_);
  for (std::size_t i = 0; i < inner_.size(); ++i) inner_[i] = values_[i] != 0;
  find_couplings_to_given();
  build_groups();
}

template <int n>
bool HarmonicExtension<n>::mixes(const NodalFrames<n>* frames) {
  for (int k = 0; k < n && frames; ++k)
    if (is_mixed(*frames, k)) return true;
  return false;
}

template <int n>
void HarmonicExtension<n>::find_couplings_to_given() {
  const NodeGraph& graph = *laplacian_.graph;
  const auto has_given = [&](int node) {
    const char* inner = inner_.data() + VectorLayout<n>::vector(node, 0);
    return std::find(inner, inner + n, char{0}) != inner + n;
  };
  coupling_offsets_ = {0};
  for (int node = 0; node < graph.rows(); ++node) {
    for (int at = graph.offsets[node]; at < graph.offsets[node + 1]; ++at)
      if (has_given(graph.columns[at])) {
        couplings_.push_back({graph.columns[at], {}});
        blocks_.push_back(at);
      }
    if (static_cast<int>(couplings_.size()) == coupling_offsets_.back()) continue;
    beside_given_.push_back(node);
    coupling_offsets_.push_back(static_cast<int>(couplings_.size()));
  }
}

template <int n>
void HarmonicExtension<n>::update() {
  rescue_.reset();
  build_groups();
}

template <int n>
void HarmonicExtension<n>::build_groups() {
  for (std::size_t c = 0; c < couplings_.size(); ++c)
    std::copy_n(laplacian_.block(blocks_[c]), n, couplings_[c].numbers);
  groups_.clear();
  for (int k = 0; k < n; ++k) {
    const bool mixed = frames_ && is_mixed(*frames_, k);
    const auto group = std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) {
      return g.mixed == mixed && (mixed || same(g.components.front(), k));
    });
    if (group != groups_.end()) {
      group->components.push_back(k);
    } else {
      groups_.emplace_back();
      groups_.back().components = {k};
      groups_.back().mixed = mixed;
    }
  }
  for (Group& group : groups_) set_up(group);
}

/// Two components have the same equations.
template <int n>
bool HarmonicExtension<n>::same(int i, int k) const {
  bool differ = false;
  for (std::size_t a = 0; a < inner_.size() && !differ; a += n) differ = inner_[a + i] != inner_[a + k];
  for (int at = 0; at < laplacian_.graph->blocks() && !differ; ++at)
    differ = laplacian_.block(at)[i] != laplacian_.block(at)[k];
  return !processes().any(differ);
}

template <int n>
bool HarmonicExtension<n>::is_mixed(const NodalFrames<n>& frames, int component) {
  return std::any_of(frames.nodes().begin(), frames.nodes().end(), [&](int node) {
    const auto& axis = (*frames.at(node))[component];
    return std::count(axis.begin(), axis.end(), 0.0) < n - 1;
  });
}

template <int n>
template <class Visit>
void HarmonicExtension<n>::for_row(const Group& group, std::size_t row, Visit visit) const {
  const auto& graph = *laplacian_.graph;
  const int node = static_cast<int>(group.entry[row] / n), component = static_cast<int>(group.entry[row] % n);
  for (int at = graph.offsets[node]; at < graph.offsets[node + 1]; ++at) {
    const int other = graph.columns[at];
    const double* numbers = laplacian_.block(at);
    if (!group.mixed || (!frames_->at(node) && !frames_->at(other))) {
      const int column = group.row[VectorLayout<n>::vector(other, component)];
      if (column >= 0) visit(column, numbers[component]);
      continue;
    }
    for (const int j : group.components) {
      const int column = group.row[VectorLayout<n>::vector(other, j)];
      if (column < 0) continue;
      double value = 0;
      for (int k = 0; k < n; ++k) value += frames_->share(k, node, other, component, j) * numbers[k];
      visit(column, value);
    }
  }
}

template <int n>
void HarmonicExtension<n>::set_up(Group& group) {
  group.row.assign(inner_.size(), -1);
  for (const bool own : {true, false}) {
    for (std::size_t node = 0; node < inner_.size(); node += n)
      for (const int component : group.components) {
        if (component != group.components.front() && !group.mixed) continue;
        if (!inner_[node + component] || owns(node / n) != own) continue;
        group.row[node + component] = static_cast<int>(group.entry.size());
        group.entry.push_back(node + component);
      }
    if (own) group.own = static_cast<int>(group.entry.size());
  }
  group.anywhere = processes().any(group.own > 0);
  group.offset = {0};
  for (std::size_t k = 1; k < group.components.size() && !group.mixed; ++k)
    group.offset.push_back(static_cast<std::size_t>(group.components[k] - group.components[0]));
  CsrMatrix<double> a, reduced;
  a.columns = static_cast<int>(group.entry.size());
  std::vector<std::pair<int, double>> entries;
  for (std::size_t row = 0; row < group.entry.size(); ++row) {
    entries.clear();
    for_row(group, row, [&](int column, double value) { entries.emplace_back(column, value); });
    if (nodes_) std::sort(entries.begin(), entries.end());
    for (const auto& [column, value] : entries) {
      a.indices.push_back(column);
      a.values.push_back(value);
    }
    a.offsets.push_back(static_cast<int>(a.indices.size()));
  }
  ScalarMultigrid::Options options;
  options.post_smoothing = true;  // conjugate gradients want a symmetric cycle
  if (nodes_) {
    group.followers = FollowerElimination(a, find_followers(group, a), group.own, reduced);
    group.share = share_of_kept(group);
  } else {
    group.followers = FollowerElimination(a, reduced);
    group.share = ShareOfNumbers(Communicator::alone(), reduced.rows(), {});
  }
  group.iterative = decide_to_iterate(group, reduced);
  if (!group.iterative) {
    if (group.anywhere) group.solver.factorise(reduced, group.share, options_.single_precision);
    return;
  }
  group.matrix = std::move(reduced);
  group.multigrid.set_up(group.matrix, group.share, options);
}

template <int n>
bool HarmonicExtension<n>::decide_to_iterate(const Group& group, const CsrMatrix<double>& a) const {
  const int nodes = group.mixed ? a.rows() / static_cast<int>(group.components.size()) : a.rows();
  const auto most = static_cast<std::int64_t>(processes().largest(nodes));
  if (SolverPolicy(SolvedSystem::harmonic_mesh_motion, n, {options_.iterative_from}).decide(most).iterates) return true;
  if (!nodes_) return false;
  const auto size = SharedCholesky::size_of(a, group.share);
  return size.separator > largest_separator || size.couplings > most_couplings;
}

template <int n>
std::vector<char> HarmonicExtension<n>::find_followers(const Group& group, const CsrMatrix<double>& a) const {
  constexpr double many = FollowerElimination::most_leaders + 1;
  const auto to_rows = [&](std::vector<double>& of_rows) {  // ghosts' from their owners
    std::vector<double> of_entries(inner_.size(), 0.0);
    for (int row = 0; row < group.own; ++row) of_entries[group.entry[row]] = of_rows[row];
    update_ghosts(of_entries);
    for (int row = group.own; row < a.rows(); ++row) of_rows[row] = of_entries[group.entry[row]];
  };
  std::vector<double> leaders(a.rows(), many), follows(a.rows(), 0.0);
  for (int row = 0; row < group.own; ++row) leaders[row] = FollowerElimination::leaders(a, row);
  to_rows(leaders);
  for (int row = 0; row < group.own; ++row) {
    follows[row] = leaders[row] < many;
    for (int at = a.offsets[row]; at < a.offsets[row + 1]; ++at)
      if (a.indices[at] != row && a.values[at] != 0 && leaders[a.indices[at]] < many) follows[row] = 0;
  }
  to_rows(follows);
  return {follows.begin(), follows.end()};
}

template <int n>
ShareOfNumbers HarmonicExtension<n>::share_of_kept(const Group& group) const {
  const auto& kept = group.followers.kept();
  const int own = group.followers.own_kept();
  const std::int64_t first = processes().sum_before(std::int64_t{own});
  std::vector<double> numbers(inner_.size(), -1.0);
  for (int i = 0; i < own; ++i) numbers[group.entry[kept[i]]] = static_cast<double>(first + i);
  update_ghosts(numbers);
  std::vector<std::int64_t> copies;
  for (std::size_t i = own; i < kept.size(); ++i)
    copies.push_back(static_cast<std::int64_t>(numbers[group.entry[kept[i]]]));
  return {processes(), own, std::move(copies)};
}

template <int n>
void HarmonicExtension<n>::solve(const std::vector<double>& right, std::vector<double>& field, double tolerance) {
  assert(right.size() == inner_.size() && field.size() == inner_.size());
  iterations_ = 0;
  parallel_for(inner_.size(), inner_.size() > 50000, [&](std::size_t i) { values_[i] = inner_[i] ? 0 : field[i]; });
  apply_operator_to_given();
  balance(right);
  bool reached = true;  // by factors in single precision
  for (Group& group : groups_) {
    if (!group.anywhere) continue;
    if (group.iterative) {
      const std::size_t count = group.offset.size();
      const bool converged = count == 1   ? iterate<1>(group, right, field, tolerance)
                             : count == 2 ? iterate<2>(group, right, field, tolerance)
                                          : iterate<3>(group, right, field, tolerance);
      if (converged) continue;
      if (nodes_) {
        if (!rescue_) {
          rescue_ = make_rescue_();
          rescue_->update();
        }
        return rescue_->solve(right, field, tolerance);
      }
      if (!group.solver.factorised()) group.solver.factorise(group.matrix, group.share, options_.single_precision);
    }
    for (std::size_t c = 0; c < group.offset.size(); ++c)
      for (int row = 0; row < group.own; ++row) field[group.entry[row] + group.offset[c]] = 0;
    add_solution(group, right, field);
    reached = reached && group.solver.reaches(tolerance);
  }
  update_ghosts(field);
  if (!reached) refine(right, field, tolerance, residual(right));
}

template <int n>
void HarmonicExtension<n>::apply_operator() {
  if (frames_) frames_->template to_space<VectorLayout<n>>(values_);
  multiply_components<n>(laplacian_, values_, rows_);
  if (frames_) frames_->template to_frames<VectorLayout<n>>(rows_);
}

template <int n>
void HarmonicExtension<n>::apply_operator_to_given() {
  if (frames_) frames_->template to_space<VectorLayout<n>>(values_);
  std::fill(rows_.begin(), rows_.end(), 0.0);
  parallel_for(beside_given_.size(), beside_given_.size() > 5000, [&](std::size_t i) {
    double* row = rows_.data() + VectorLayout<n>::vector(beside_given_[i], 0);
    for (int c = coupling_offsets_[i]; c < coupling_offsets_[i + 1]; ++c) {
      const double* value = values_.data() + VectorLayout<n>::vector(couplings_[c].column, 0);
      for (int k = 0; k < n; ++k) row[k] += couplings_[c].numbers[k] * value[k];
    }
  });
  if (frames_) frames_->template to_frames<VectorLayout<n>>(rows_);
}

template <int n>
void HarmonicExtension<n>::balance(const std::vector<double>& right) {
  if (!nodes_) return;
  balance_.resize(rows_.size());
  for (std::size_t i = 0; i < rows_.size(); ++i) balance_[i] = right[i] - rows_[i];
  update_ghosts(balance_);
}

template <int n>
void HarmonicExtension<n>::take(const Group& group, const std::vector<double>& right) {
  const std::size_t rows = group.entry.size(), count = group.offset.size();
  right_.resize(rows * count);
  for (std::size_t c = 0; c < count; ++c)
    for (std::size_t i = 0; i < rows; ++i) {
      const std::size_t entry = group.entry[i] + group.offset[c];
      right_[c * rows + i] = nodes_ ? balance_[entry] : right[entry] - rows_[entry];
    }
}

template <int n>
void HarmonicExtension<n>::add_solution(const Group& group, const std::vector<double>& right,
                                        std::vector<double>& field) {
  const std::size_t rows = group.entry.size(), count = group.offset.size();
  take(group, right);
  group.followers.reduce(right_, static_cast<int>(count), right_of_kept_);
  group.solver.solve(right_of_kept_, static_cast<int>(count), kept_);
  if (nodes_) add_copies(group);
  group.followers.complete(right_, kept_, static_cast<int>(count), solution_);
  for (std::size_t c = 0; c < count; ++c)
    for (int i = 0; i < group.own; ++i) field[group.entry[i] + group.offset[c]] += solution_[c * rows + i];
}

template <int n>
void HarmonicExtension<n>::add_copies(const Group& group) {
  const std::size_t count = group.offset.size(), own = group.share.own, items = group.share.items();
  exchanged_.resize(items * count);
  for (std::size_t c = 0; c < count; ++c)
    for (std::size_t i = 0; i < own; ++i) exchanged_[i * count + c] = kept_[own * c + i];
  group.share.exchange.update(exchanged_, static_cast<int>(count));
  kept_.resize(items * count);
  for (std::size_t c = 0; c < count; ++c)
    for (std::size_t i = 0; i < items; ++i) kept_[items * c + i] = exchanged_[i * count + c];
}

template <int n>
void HarmonicExtension<n>::refine(const std::vector<double>& right, std::vector<double>& field, double tolerance,
                                  double reference) {
  double last = reference;
  for (int k = 0; k < CholeskySolver::most_corrections; ++k) {
    values_ = field;
    apply_operator();
    const double left = residual(right);
    if (left <= tolerance * reference || !(left < 0.5 * last)) return;
    last = left;
    balance(right);
    for (const Group& group : groups_)
      if (group.solver.residual() > 0) add_solution(group, right, field);
    update_ghosts(field);
  }
}

template <int n>
double HarmonicExtension<n>::residual(const std::vector<double>& right) const {
  double sum = 0;
  for (const Group& group : groups_) {
    if (!(group.solver.residual() > 0)) continue;
    for (const std::size_t offset : group.offset)
      for (int row = 0; row < group.own; ++row) {
        const std::size_t entry = group.entry[row] + offset;
        const double residual = right[entry] - rows_[entry];
        sum += residual * residual;
      }
  }
  return std::sqrt(processes().sum(sum));
}

/// Preconditioned conjugate gradients, one of their own for each component, in step. beta = z . (r - r_old) / rho_old
/// allows for a preconditioner that is linear but for the rounding of single precision.
template <int n>
template <int m>
bool HarmonicExtension<n>::iterate(Group& group, const std::vector<double>& right, std::vector<double>& field,
                                   double tolerance) {
  constexpr int lanes = m == 1 ? 1 : padded<m>;
  const auto& kept = group.followers.kept();
  const int rows = group.followers.own_kept();
  const std::size_t size = static_cast<std::size_t>(rows) * m, with_copies = kept.size() * m;
  std::vector<double> x(with_copies), r(size), z(size), p(with_copies, 0.0), q(size);
  std::vector<float> single_r(static_cast<std::size_t>(rows) * lanes, 0.0f), single_z(single_r);
  const auto sums = [&](const std::vector<double>& u, const std::vector<double>& v) {
    auto of_all = dots<m>(rows, u, v);
    processes().sum(of_all.data(), m);
    return of_all;
  };
  take(group, right);
  group.followers.reduce(right_, m, right_of_kept_);
  for (std::size_t i = 0; i < kept.size(); ++i)
    for (int k = 0; k < m; ++k) x[i * m + k] = field[group.entry[kept[i]] + group.offset[k]];
  group.share.exchange.update(x, m);
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < m; ++k)
      r[static_cast<std::size_t>(i) * m + k] = right_of_kept_[static_cast<std::size_t>(k) * rows + i];
  const auto reference = sums(r, r);
  multiply_each<m>(group.matrix, x, q);
  for (std::size_t i = 0; i < size; ++i) r[i] -= q[i];
  auto square = sums(r, r);
  const auto done = [&] {
    for (int k = 0; k < m; ++k)
      if (!(square[k] <= tolerance * tolerance * reference[k])) return false;
    return true;
  };
  std::array<double, m> rho{}, alpha{}, beta{};
  int iteration = 0;
  for (; !done() && iteration < options_.max_iterations; ++iteration) {
    // Scaled to one, so that small residuals do not leave the range of single precision.
    double length[m];
    for (int k = 0; k < m; ++k) length[k] = std::sqrt(square[k]);
#pragma omp parallel for schedule(static) if (rows > 8000)
    for (int i = 0; i < rows; ++i)
      for (int k = 0; k < m; ++k)
        single_r[static_cast<std::size_t>(i) * lanes + k] =
            length[k] > 0 ? static_cast<float>(r[static_cast<std::size_t>(i) * m + k] / length[k]) : 0.0f;
    group.multigrid.template cycle_each<m>(single_r, single_z);
#pragma omp parallel for schedule(static) if (rows > 8000)
    for (int i = 0; i < rows; ++i)
      for (int k = 0; k < m; ++k)
        z[static_cast<std::size_t>(i) * m + k] = length[k] * single_z[static_cast<std::size_t>(i) * lanes + k];
    const auto overlap = sums(z, q), next = sums(z, r);
    for (int k = 0; k < m; ++k) {
      beta[k] = iteration > 0 && rho[k] > 0 ? -alpha[k] * overlap[k] / rho[k] : 0;  // r - r_old = -alpha q
      rho[k] = next[k];
    }
#pragma omp parallel for schedule(static) if (rows > 8000)
    for (int i = 0; i < rows; ++i)
      for (int k = 0; k < m; ++k) {
        const std::size_t at = static_cast<std::size_t>(i) * m + k;
        p[at] = z[at] + beta[k] * p[at];
      }
    group.share.exchange.update(p, m);
    multiply_each<m>(group.matrix, p, q);
    const auto curvature = sums(p, q);
    for (int k = 0; k < m; ++k) alpha[k] = curvature[k] > 0 ? rho[k] / curvature[k] : 0;
#pragma omp parallel for schedule(static) if (rows > 8000)
    for (int i = 0; i < rows; ++i)
      for (int k = 0; k < m; ++k) {
        const std::size_t at = static_cast<std::size_t>(i) * m + k;
        x[at] += alpha[k] * p[at];
        r[at] -= alpha[k] * q[at];
      }
    square = sums(r, r);
  }
  iterations_ = std::max(iterations_, iteration);
  if (!done()) return false;
  group.share.exchange.update(x, m);
  kept_.resize(with_copies);
  for (std::size_t i = 0; i < kept.size(); ++i)
    for (int k = 0; k < m; ++k) kept_[k * kept.size() + i] = x[i * m + k];
  group.followers.complete(right_, kept_, m, solution_);
  const std::size_t all = group.entry.size();
  for (int i = 0; i < group.own; ++i)
    for (int k = 0; k < m; ++k) field[group.entry[i] + group.offset[k]] = solution_[k * all + i];
  return true;
}

template <int n>
bool HarmonicExtension<n>::iterates() const {
  return std::all_of(groups_.begin(), groups_.end(),
                     [](const Group& g) { return g.iterative && !g.solver.factorised(); });
}

template <int n>
double HarmonicExtension<n>::memory_mib() const {
  double bytes = 0;
  for (const Group& group : groups_)
    bytes += group.solver.bytes() +
             static_cast<double>(group.followers.bytes() + group.matrix.bytes() + group.multigrid.bytes());
  return bytes / (1 << 20) + (rescue_ ? rescue_->memory_mib() : 0);
}

template class HarmonicExtension<2>;
template class HarmonicExtension<3>;

}  // namespace fsi
