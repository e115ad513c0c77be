#include "linear/direct/cholesky_solver.hpp"

#include <cholmod.h>

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "algebra/panel_matrix.hpp"
#include "base/error.hpp"
#include "host/available_memory.hpp"
#include "linear/direct/dense_threads.hpp"
#include "linear/direct/factorisation_memory.hpp"
#include "linear/direct/single_cholesky.hpp"

namespace fsi {

namespace {

/// Parallel regions run on one thread as long as this lives. CHOLMOD opens thousands of small ones, of four threads
/// whatever their number shall be: on fewer cores, or beside another job, they mostly wait for each other.
class SerialRegions {
 public:
  SerialRegions() : before_(omp_get_max_active_levels()) { omp_set_max_active_levels(0); }
  ~SerialRegions() { omp_set_max_active_levels(before_); }
  SerialRegions(const SerialRegions&) = delete;
  SerialRegions& operator=(const SerialRegions&) = delete;

 private:
  int before_;
};

constexpr double largest_residual = 1e-5;  // of a factor in single precision

Supernodes supernodes(const cholmod_factor& factor) {
  return {static_cast<int>(factor.nsuper),
          static_cast<const std::int64_t*>(factor.super),
          static_cast<const std::int64_t*>(factor.pi),
          static_cast<const std::int64_t*>(factor.px),
          static_cast<const std::int64_t*>(factor.s),
          static_cast<const double*>(factor.x)};
}

}  // namespace

struct CholeskySolver::Implementation {
  cholmod_common common;
  std::optional<SingleCholesky> single;  ///< in place of `factor`
  double residual = 0;                   ///< of its solutions
  std::vector<std::int64_t> order;       ///< of a matrix with that many entries
  std::int64_t entries = 0;
  cholmod_factor* factor = nullptr;
  // Storage of solves: solution, and two arrays of CHOLMOD's own.
  mutable cholmod_dense *solution = nullptr, *work = nullptr, *extra = nullptr;

  Implementation() {
    cholmod_l_start(&common);
    common.print = 0;
    common.nmethods = 1;
    common.final_ll = 1;
  }
  ~Implementation() {
    free_double();
    cholmod_l_finish(&common);
  }
  /// A new factor's pattern.
  void analyse(cholmod_sparse& a) {
    const bool known = order.size() == a.nrow && entries == static_cast<std::int64_t>(a.nzmax);
    common.method[0].ordering = known ? CHOLMOD_GIVEN : CHOLMOD_METIS;
    common.postorder = !known;  // the order found is one already
    factor = cholmod_l_analyze_p(&a, known ? order.data() : nullptr, nullptr, 0, &common);
    if (common.status != CHOLMOD_OK) return;
    const auto* found = static_cast<const std::int64_t*>(factor->Perm);
    order.assign(found, found + factor->n);
    entries = static_cast<std::int64_t>(a.nzmax);
  }
  void free_double() {
    cholmod_l_free_dense(&solution, &common);
    cholmod_l_free_dense(&work, &common);
    cholmod_l_free_dense(&extra, &common);
    cholmod_l_free_factor(&factor, &common);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  [[noreturn]] static void refuse() {
    throw ConvergenceError("sparse factorisation: the matrix is not positive definite or holds NaN",
                           "a smaller time step, and check the mesh");
  }
  /// \throws as the last call ended
  void check(std::int64_t unknowns) const {
    if (common.status == CHOLMOD_OK) return;
    if (common.status == CHOLMOD_OUT_OF_MEMORY)
      throw OutOfMemory(fmt::format("the factor of {} unknowns does not fit", unknowns));
    refuse();
  }
};

CholeskySolver::CholeskySolver() : implementation_(std::make_unique<Implementation>()) {}
CholeskySolver::~CholeskySolver() = default;
CholeskySolver::CholeskySolver(CholeskySolver&&) noexcept = default;
CholeskySolver& CholeskySolver::operator=(CholeskySolver&&) noexcept = default;

bool CholeskySolver::factorised() const {
  return implementation_->factor != nullptr || implementation_->single;
}

double CholeskySolver::residual() const {
  return implementation_->residual;
}

void CholeskySolver::reduce_precision(const SparseMatrix& a) {
  auto& my = *implementation_;
  if (!my.factor || !my.factor->is_super || !my.factor->is_ll) return;
  SingleCholesky single(supernodes(*my.factor), static_cast<const std::int64_t*>(my.factor->Perm));
  const std::vector<double> ones(my.factor->n, 1.0);
  const std::vector<double> b = product(a, ones);
  std::vector<double> x(b.size());
  single.solve(b.data(), 1, x.data());
  x = product(a, x);
  double left = 0, whole = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    left += (b[i] - x[i]) * (b[i] - x[i]);
    whole += b[i] * b[i];
  }
  const double residual = std::sqrt(left / whole);
  if (!(residual <= largest_residual)) return;
  my.residual = residual;
  my.single = std::move(single);
  my.free_double();
}

void CholeskySolver::factorise(const SparseMatrix& a) {
  const OneDenseThread same_bits_for_any_number;
  const Activity activity("factorising a matrix");
  auto& my = *implementation_;
  cholmod_l_free_factor(&my.factor, &my.common);
  my.single.reset();
  my.residual = 0;
  // CHOLMOD takes a pivot that is no number for a positive one.
  if (!std::all_of(a.values.begin(), a.values.end(), [](double value) { return std::isfinite(value); })) my.refuse();
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(a.size());
  view.nzmax = static_cast<std::size_t>(a.nonzeros());
  view.p = const_cast<std::int64_t*>(a.offsets.data());  // CHOLMOD's interface has no const; it only reads
  view.i = const_cast<std::int64_t*>(a.rows.data());
  view.x = const_cast<double*>(a.values.data());
  view.stype = 1;  // the upper half is read
  view.itype = CHOLMOD_LONG;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  my.analyse(view);
  my.check(a.size());
  const double expected = 1.2 * sizeof(double) * my.common.lnz;  // blocks hold some zeros besides
  if (expected > (1 << 20) && will_not_fit(expected, static_cast<double>(available_memory().bytes)))
    throw OutOfMemory(fmt::format("the factor of {} unknowns takes about {}", a.size(), memory_text(expected)));
  start_dense_threads();
  {
    const SerialRegions not_four_threads;
    cholmod_l_factorize(&view, my.factor, &my.common);
  }
  if (my.common.status != CHOLMOD_OK || my.factor->minor < my.factor->n) {
    if (my.common.status == CHOLMOD_OK) my.common.status = CHOLMOD_NOT_POSDEF;
    cholmod_l_free_factor(&my.factor, &my.common);
    my.check(a.size());
  }
}

void CholeskySolver::solve(const std::vector<double>& b, int count, std::vector<double>& x) const {
  const auto& my = *implementation_;
  x.resize(b.size());
  if (my.single) return my.single->solve(b.data(), count, x.data());
  solve_in_double(b, count, x);
}

void CholeskySolver::solve_in_double(const std::vector<double>& b, int count, std::vector<double>& x) const {
  const OneDenseThread same_bits_for_any_number;
  auto& my = *implementation_;
  assert(my.factor && b.size() == my.factor->n * static_cast<std::size_t>(count));
  start_dense_threads();
  cholmod_dense right{};
  right.nrow = right.d = my.factor->n;
  right.ncol = static_cast<std::size_t>(count);
  right.nzmax = b.size();
  right.x = const_cast<double*>(b.data());  // as above
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  cholmod_l_solve2(CHOLMOD_A, my.factor, &right, nullptr, &my.solution, nullptr, &my.work, &my.extra, &my.common);
  my.check(static_cast<std::int64_t>(my.factor->n));
  const auto* first = static_cast<const double*>(my.solution->x);
  x.assign(first, first + b.size());
}

double CholeskySolver::bytes() const {
  if (implementation_->single) return static_cast<double>(implementation_->single->bytes());
  const auto* factor = implementation_->factor;
  if (!factor) return 0;
  return factor->is_super ? static_cast<double>(factor->xsize * sizeof(double) + factor->ssize * sizeof(std::int64_t))
                          : static_cast<double>(factor->nzmax * (sizeof(double) + sizeof(std::int64_t)));
}

}  // namespace fsi
