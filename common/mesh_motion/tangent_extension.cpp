#include "mesh_motion/tangent_extension.hpp"

#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "algebra/block_products.hpp"
#include "algebra/vector_operations.hpp"
#include "base/error.hpp"
#include "fem/dimensions.hpp"
#include "fem/nodal_layout.hpp"
#include "linear/policy/solver_policy.hpp"

namespace fsi {

template <int n>
TangentExtension<n>::TangentExtension(const MeshMotionTangent<n>& tangent, std::vector<char> inner,
                                      const TangentExtensionOptions& options)
    : tangent_(tangent), options_(options), inner_(std::move(inner)), row_(inner_.size(), -1) {
  assert(inner_.size() == static_cast<std::size_t>(tangent.graph->rows()) * n);
  for (std::size_t i = 0; i < inner_.size(); ++i)
    if (inner_[i]) {
      row_[i] = static_cast<int>(entry_.size());
      rows_of_[i % n].push_back(row_[i]);
      entry_.push_back(i);
    }
  const int nodes = static_cast<int>(entry_.size()) / n;
  iterative_ = SolverPolicy(SolvedSystem::tangent_mesh_motion, n, {options_.iterative_from}).decide(nodes).iterates;
  given_.resize(inner_.size());
  boundary_rows_ = given_;
}

template <int n>
void TangentExtension<n>::update() {
  if (entry_.empty()) return;
  matrix_.columns = static_cast<int>(entry_.size());
  matrix_.offsets = {0};
  matrix_.indices.clear();
  matrix_.values.clear();
  const NodeGraph& graph = *tangent_.graph;
  for (const std::size_t entry : entry_) {
    const int node = static_cast<int>(entry / n), i = static_cast<int>(entry % n);
    for (int at = graph.offsets[node]; at < graph.offsets[node + 1]; ++at)
      for (int j = 0; j < n; ++j) {
        const int column = row_[VectorLayout<n>::vector(graph.columns[at], j)];
        if (column < 0) continue;
        matrix_.indices.push_back(column);
        matrix_.values.push_back(tangent_.block(at)[i * n + j]);
      }
    matrix_.offsets.push_back(static_cast<int>(matrix_.indices.size()));
  }
  if (iterative_ && factorised()) {  // the last values' iteration had failed
    cholesky_ = CholeskySolver();
    solver_ = DirectSolver();
  }
  iterative_ ? set_up_multigrid() : factorise();
}

template <int n>
void TangentExtension<n>::set_up_multigrid() {
  ScalarMultigrid::Options options;
  options.post_smoothing = true;  // conjugate gradients want a symmetric cycle
  std::vector<int> place(entry_.size(), -1);
  for (int k = 0; k < n; ++k) {
    CsrMatrix<double> own;
    own.columns = static_cast<int>(rows_of_[k].size());
    for (std::size_t i = 0; i < rows_of_[k].size(); ++i) place[rows_of_[k][i]] = static_cast<int>(i);
    for (const int row : rows_of_[k]) {
      for (int at = matrix_.offsets[row]; at < matrix_.offsets[row + 1]; ++at) {
        const int column = matrix_.indices[at];
        if (static_cast<int>(entry_[column] % n) != k) continue;
        own.indices.push_back(place[column]);
        own.values.push_back(matrix_.values[at]);
      }
      own.offsets.push_back(static_cast<int>(own.indices.size()));
    }
    if (own.rows() > 0) multigrid_[k].set_up(own, options);
  }
}

template <int n>
void TangentExtension<n>::factorise() {
  columns_.offsets.assign(matrix_.offsets.begin(), matrix_.offsets.end());
  columns_.rows.assign(matrix_.indices.begin(), matrix_.indices.end());
  columns_.values = matrix_.values;
  solver_.discard();
  try {
    cholesky_.factorise(columns_);
  } catch (const ConvergenceError&) {
    cholesky_ = CholeskySolver();
    return solver_.factorise(columns_);
  }
  if (options_.single_precision) cholesky_.reduce_precision(columns_);
}

template <int n>
void TangentExtension<n>::solve_by_factors(const std::vector<double>& b, double tolerance,
                                           std::vector<double>& x) const {
  if (solver_.factorised()) return solver_.solve(columns_, b, x);
  cholesky_.solve(b, 1, x);
  if (cholesky_.reaches(tolerance)) return;
  std::vector<double> residual(b.size()), correction;
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < CholeskySolver::most_corrections; ++k) {
    apply(x, residual);
    for (std::size_t i = 0; i < b.size(); ++i) residual[i] = b[i] - residual[i];
    const double left = norm(residual);
    if (left <= tolerance * norm(b) || !(left < 0.5 * last)) return;
    last = left;
    cholesky_.solve(residual, 1, correction);
    axpy(1, correction, x);
  }
}

template <int n>
void TangentExtension<n>::apply(const std::vector<double>& v, std::vector<double>& out) const {
#pragma omp parallel for schedule(static) if (v.size() > 8000)
  for (std::size_t row = 0; row < v.size(); ++row)
    out[row] = row_product(matrix_, matrix_.offsets[row], matrix_.offsets[row + 1], v.data());
}

template <int n>
void TangentExtension<n>::solve(const std::vector<double>& right, std::vector<double>& field, double tolerance) {
  assert(right.size() == inner_.size() && field.size() == inner_.size());
  iterations_ = 0;
  if (entry_.empty()) return;
  for (std::size_t i = 0; i < inner_.size(); ++i) given_[i] = inner_[i] ? 0 : field[i];
  multiply(tangent_, given_, boundary_rows_);
  std::vector<double> b(entry_.size()), x(entry_.size());
  for (std::size_t row = 0; row < entry_.size(); ++row) {
    b[row] = right[entry_[row]] - boundary_rows_[entry_[row]];
    x[row] = field[entry_[row]];
  }
  if (!iterates() || !iterate(b, x, tolerance)) {
    if (!factorised()) factorise();
    solve_by_factors(b, tolerance, x);
  }
  for (std::size_t row = 0; row < entry_.size(); ++row) field[entry_[row]] = x[row];
}

/// Conjugate gradients; beta as in HarmonicExtension<n>::iterate, for the same reason.
template <int n>
bool TangentExtension<n>::iterate(const std::vector<double>& b, std::vector<double>& x, double tolerance) {
  const std::size_t size = b.size();
  std::vector<double> r(size), z(size), p(size, 0.0), q(size);
  const double reference = dot(b, b);
  apply(x, q);
  for (std::size_t i = 0; i < size; ++i) r[i] = b[i] - q[i];
  double square = dot(r, r), rho = 0, alpha = 0;
  while (!(square <= tolerance * tolerance * reference)) {
    if (iterations_ == options_.max_iterations || !std::isfinite(square)) return false;
    precondition(r, z);
    const double next = dot(z, r);
    const double beta = iterations_ > 0 ? -alpha * dot(z, q) / rho : 0;  // r - r_old = -alpha q
    rho = next;
    for (std::size_t i = 0; i < size; ++i) p[i] = z[i] + beta * p[i];
    apply(p, q);
    const double curvature = dot(p, q);
    if (!(curvature > 0 && rho > 0)) return false;
    alpha = rho / curvature;
    axpy(alpha, p, x);
    axpy(-alpha, q, r);
    square = dot(r, r);
    ++iterations_;
  }
  return true;
}

/// Scaled to one, so that small residuals do not leave the range of single precision.
template <int n>
void TangentExtension<n>::precondition(const std::vector<double>& r, std::vector<double>& z) {
  const double length = norm(r);
  for (int k = 0; k < n; ++k) {
    const auto& rows = rows_of_[k];
    if (rows.empty()) continue;
    single_r_.resize(rows.size());
    single_z_.assign(rows.size(), 0.0f);
    for (std::size_t i = 0; i < rows.size(); ++i) single_r_[i] = static_cast<float>(r[rows[i]] / length);
    multigrid_[k].cycle(single_r_, single_z_);
    for (std::size_t i = 0; i < rows.size(); ++i) z[rows[i]] = length * single_z_[i];
  }
}

template <int n>
double TangentExtension<n>::memory_mib() const {
  double bytes = static_cast<double>(matrix_.bytes());
  if (cholesky_.factorised()) bytes += cholesky_.bytes();
  if (solver_.factorised()) bytes += 16.0 * static_cast<double>(solver_.factor_nonzeros());
  for (const auto& cycle : multigrid_) bytes += static_cast<double>(cycle.bytes());
  return bytes / (1 << 20);
}

#define FSI_INSTANTIATE(n) template class TangentExtension<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
