#include "linear/direct/direct_solver.hpp"

#include <umfpack.h>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <iterator>

#include "base/error.hpp"
#include "host/available_memory.hpp"
#include "linear/direct/factorisation_memory.hpp"
#include "linear/direct/single_factors.hpp"

namespace fsi {

namespace {

/// What elimination may leave of a column's largest entry, rows scaled, for factors to be trusted. Less is left of singular
/// matrices, and of others whose rows differ much in size.
constexpr double trusted_pivot = 1e-12;
/// What may be wrong of a solution, relative to its largest unknown, columns scaled.
constexpr double largest_solution_error = 1e-3;

thread_local bool refused = false;  // an allocation for UMFPACK has failed

void* noticed(void* memory) {
  refused = refused || memory == nullptr;
  return memory;
}

// UMFPACK copes with allocations that fail: it asks for less.
void* malloc_for_umfpack(std::size_t size) {
  const MayFail umfpack_asks_for_less;
  return noticed(std::malloc(size));
}
void* calloc_for_umfpack(std::size_t count, std::size_t size) {
  const MayFail umfpack_asks_for_less;
  return noticed(std::calloc(count, size));
}
void* realloc_for_umfpack(void* old, std::size_t size) {
  const MayFail umfpack_asks_for_less;
  return noticed(std::realloc(old, size));
}
const bool umfpack_may_fail = [] {
#if SUITESPARSE_VERSION >= SUITESPARSE_VER_CODE(6, 0)
  SuiteSparse_config_malloc_func_set(malloc_for_umfpack);
  SuiteSparse_config_calloc_func_set(calloc_for_umfpack);
  SuiteSparse_config_realloc_func_set(realloc_for_umfpack);
#else
  SuiteSparse_config.malloc_func = malloc_for_umfpack;
  SuiteSparse_config.calloc_func = calloc_for_umfpack;
  SuiteSparse_config.realloc_func = realloc_for_umfpack;
#endif
  return true;
}();

}  // namespace

struct DirectSolver::Implementation {
  double control[UMFPACK_CONTROL];
  void* symbolic = nullptr;
  void* numeric = nullptr;
  double lower = 0, upper = 0;
  double bytes = 0;        ///< that a factorisation is expected to take
  double bound_bytes = 0;  ///< UMFPACK's bound for the factors alone
  bool warned = false;
  mutable std::vector<SuiteSparse_long> integer_work;
  mutable std::vector<double> work;
  bool wants_single = false;
  SingleFactors single;
  SparseMatrix doubtful;  ///< the matrix factorised where a known solution does not come back; else empty

  explicit Implementation(const Options& options) : wants_single(options.single_precision) {
    umfpack_dl_defaults(control);
    control[UMFPACK_ORDERING] = options.ordering == "metis"  ? UMFPACK_ORDERING_METIS
                                : options.ordering == "best" ? UMFPACK_ORDERING_BEST
                                                             : UMFPACK_ORDERING_AMD;
    control[UMFPACK_STRATEGY] = options.strategy == "unsymmetric" ? UMFPACK_STRATEGY_UNSYMMETRIC
                                : options.strategy == "symmetric" ? UMFPACK_STRATEGY_SYMMETRIC
                                                                  : UMFPACK_STRATEGY_AUTO;
    control[UMFPACK_IRSTEP] = options.refinement_steps;
  }
  /// From what the symbolic analysis says.
  void expect_memory(const double* info) {
    bound_bytes = info[UMFPACK_NUMERIC_SIZE_ESTIMATE] * info[UMFPACK_SIZE_OF_UNIT];
    bytes = info[UMFPACK_STRATEGY_USED] == UMFPACK_STRATEGY_SYMMETRIC && info[UMFPACK_SYMMETRIC_LUNZ] > 0
                ? factorisation_bytes(info[UMFPACK_SYMMETRIC_LUNZ], info[UMFPACK_NZ])
                : bound_bytes / 5;  // no estimate there; the least that was seen beside the bound
  }

  std::string asked(std::int64_t unknowns) const {
    return fmt::format("the factors of {} unknowns take about {}", unknowns, memory_text(bytes));
  }

  /// Refuses what does not fit and warns, once, of what takes much.
  void require_memory(std::int64_t unknowns) {
    control[UMFPACK_ALLOC_INIT] = UMFPACK_DEFAULT_ALLOC_INIT;
    if (bytes < (std::size_t{1} << 20)) return;  // many small ones are factorised
    const auto room = static_cast<double>(available_memory().bytes);
    if (will_not_fit(bytes, room)) throw OutOfMemory(asked(unknowns));
    // UMFPACK first takes 0.7 times its bound, else all that it gets. That leaves nothing for others where little is.
    if (0.7 * bound_bytes > 0.5 * room) control[UMFPACK_ALLOC_INIT] = std::min(0.7, 1.2 * bytes / bound_bytes);
    if (warned || !takes_more_than_half(bytes, room)) return;
    warned = true;
    memory_notice(fmt::format("{}, more than half of the {} available", asked(unknowns), memory_text(room)));
  }

  /// Factors in single precision in place of UMFPACK's, unless they do not serve.
  void shorten(const SparseMatrix& a);
  /// x = A^-1 b by the factors, once.
  void solve_once(const SparseMatrix& a, const std::vector<double>& b, std::vector<double>& x) const;
  /// The least that elimination has left of a column's largest entry, rows scaled.
  double least_pivot(const SparseMatrix& a) const;
  /// Whether a known solution comes back from its right-hand side.
  bool solves_known(const SparseMatrix& a) const;
  /// \throws ConvergenceError where x, that the factors of `doubtful` gave, is not determined by b
  void require_determined(const std::vector<double>& b, const std::vector<double>& x) const;

  ~Implementation() {
    if (numeric) umfpack_dl_free_numeric(&numeric);
    if (symbolic) umfpack_dl_free_symbolic(&symbolic);
  }
};

namespace {
const SuiteSparse_long* indices(const std::vector<std::int64_t>& v) {
  static_assert(sizeof(SuiteSparse_long) == sizeof(std::int64_t));
  return reinterpret_cast<const SuiteSparse_long*>(v.data());
}
SuiteSparse_long* indices(std::vector<std::int64_t>& v) {
  return reinterpret_cast<SuiteSparse_long*>(v.data());
}
}  // namespace

void DirectSolver::Implementation::shorten(const SparseMatrix& a) {
  const std::size_t size = static_cast<std::size_t>(a.size());
  // While they are made, a copy of one factor in double precision is there besides.
  if (takes_more_than_half(16 * (lower + upper), static_cast<double>(available_memory().bytes))) return;
  const auto factor = [size](double entries) {
    SparseMatrix made;
    made.offsets.resize(size + 1);
    made.rows.resize(static_cast<std::size_t>(entries));
    made.values.resize(static_cast<std::size_t>(entries));
    return made;
  };
  std::vector<std::int64_t> row_order(size), column_order(size);
  std::vector<double> row_scale(size);
  SuiteSparse_long divide_not = 0;
  SparseMatrix rows = factor(lower);
  auto status = umfpack_dl_get_numeric(indices(rows.offsets), indices(rows.rows), rows.values.data(), nullptr, nullptr,
                                       nullptr, indices(row_order), indices(column_order), nullptr, &divide_not,
                                       row_scale.data(), numeric);
  if (status != UMFPACK_OK) return;
  if (divide_not == 0)
    for (double& scale : row_scale) scale = 1 / scale;
  single = SingleFactors(a, row_order, column_order, row_scale);
  single.set_lower(rows);
  rows = {};
  SparseMatrix columns = factor(upper);
  status = umfpack_dl_get_numeric(nullptr, nullptr, nullptr, indices(columns.offsets), indices(columns.rows),
                                  columns.values.data(), nullptr, nullptr, nullptr, nullptr, nullptr, numeric);
  if (status == UMFPACK_OK) {
    single.set_upper(columns);
    columns = {};
    if (single.serve()) {
      umfpack_dl_free_numeric(&numeric);
      return;
    }
  }
  single = {};
}

namespace {

/// Largest amounts in columns, after rows are divided by theirs: unknowns times these are of one size, whatever their units.
std::vector<double> column_scales(const SparseMatrix& a) {
  std::vector<double> rows(static_cast<std::size_t>(a.size()), 0.0), columns(rows);
  for (std::size_t k = 0; k < a.rows.size(); ++k) rows[a.rows[k]] = std::max(rows[a.rows[k]], std::abs(a.values[k]));
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (auto k = a.offsets[c]; k < a.offsets[c + 1]; ++k)
      if (a.values[k] != 0) columns[c] = std::max(columns[c], std::abs(a.values[k]) / rows[a.rows[k]]);
  return columns;
}

double largest(const std::vector<double>& x, const std::vector<double>& scales) {
  double found = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (const double size = scales[i] * std::abs(x[i]); !(size <= found)) found = size;  // NaN stays
  return found;
}

}  // namespace

void DirectSolver::Implementation::solve_once(const SparseMatrix& a, const std::vector<double>& b,
                                              std::vector<double>& x) const {
  x.resize(b.size());
  work.resize(b.size() * 5);
  start_dense_threads();
  double info[UMFPACK_INFO];
  const auto status = umfpack_dl_wsolve(UMFPACK_A, indices(a.offsets), indices(a.rows), a.values.data(), x.data(),
                                        b.data(), numeric, control, info, integer_work.data(), work.data());
  if (status != UMFPACK_OK)
    throw ConvergenceError(fmt::format("sparse solve failed (UMFPACK status {})", status), "a smaller time step");
}

double DirectSolver::Implementation::least_pivot(const SparseMatrix& a) const {
  const auto size = static_cast<std::size_t>(a.size());
  std::vector<std::int64_t> column_order(size);
  std::vector<double> pivots(size), row_scale(size);
  SuiteSparse_long multiplies = 0;  // else divides
  if (umfpack_dl_get_numeric(nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, indices(column_order),
                             pivots.data(), &multiplies, row_scale.data(), numeric) != UMFPACK_OK)
    return 0;
  if (multiplies != 0)
    for (double& scale : row_scale) scale = 1 / scale;
  double least = 1;
  for (std::size_t i = 0; i < size; ++i) {
    const std::int64_t c = column_order[i];
    double largest = 0;
    for (auto k = a.offsets[c]; k < a.offsets[c + 1]; ++k)
      largest = std::max(largest, std::abs(a.values[k]) / row_scale[a.rows[k]]);
    if (const double left = std::abs(pivots[i]) / largest; !(left >= least)) least = left;  // NaN stays
  }
  return least;
}

// Factors are those of A + E, E of the size of rounding, so that x comes back as x - (A + E)^-1 E x. Where A is singular and n in
// its kernel, (A + E) n = E n, and what is lost is of the size of x.
bool DirectSolver::Implementation::solves_known(const SparseMatrix& a) const {
  const std::vector<double> scales = column_scales(a);
  std::vector<double> known(scales.size()), x;
  // 0.5 to 1.5 in a sequence without a period: what is lost of equal numbers may cancel.
  for (std::size_t i = 0; i < known.size(); ++i)
    known[i] = (0.5 + std::fmod(0.6180339887498949 * static_cast<double>(i + 1), 1.0)) / scales[i];
  solve_once(a, product(a, known), x);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] -= known[i];
  return largest(x, scales) <= largest_solution_error;  // false for NaN
}

// A second solve, of what rounding has left of the right-hand side, changes x by about what the first one has lost of it.
void DirectSolver::Implementation::require_determined(const std::vector<double>& b,
                                                      const std::vector<double>& x) const {
  const std::vector<double> scales = column_scales(doubtful);
  std::vector<double> left = product(doubtful, x), lost;
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = b[i] - left[i];
  solve_once(doubtful, left, lost);
  const double wrong = largest(lost, scales), size = largest(x, scales);
  if (wrong <= largest_solution_error * size) return;
  throw ConvergenceError(
      fmt::format("sparse factorisation: the matrix is singular to working precision, since a second solve changes the "
                  "first one's solution by {:.1e} of it",
                  wrong / size),
      "a smaller time step, and check the materials");
}

DirectSolver::DirectSolver() : DirectSolver(Options{}) {}
DirectSolver::DirectSolver(const Options& options) : implementation_(std::make_unique<Implementation>(options)) {}
DirectSolver::~DirectSolver() = default;
DirectSolver::DirectSolver(DirectSolver&&) noexcept = default;
DirectSolver& DirectSolver::operator=(DirectSolver&&) noexcept = default;

bool DirectSolver::factorised() const {
  return implementation_->numeric != nullptr || !implementation_->single.empty();
}

void DirectSolver::discard() {
  implementation_->doubtful = {};
  if (implementation_->numeric) umfpack_dl_free_numeric(&implementation_->numeric);
  implementation_->single = {};
}

void DirectSolver::factorise(const SparseMatrix& a) {
  const OneDenseThread same_bits_for_any_number;
  auto& my = *implementation_;
  assert(a.rows.size() == a.values.size() && a.offsets.back() == a.nonzeros());
  const auto* offsets = indices(a.offsets);
  const auto* rows = indices(a.rows);
  double info[UMFPACK_INFO];
  const Activity activity("factorising a matrix");
  if (!my.symbolic) {
    refused = false;
    const auto status =
        umfpack_dl_symbolic(a.size(), a.size(), offsets, rows, a.values.data(), &my.symbolic, my.control, info);
    // An ordering that gets no memory is replaced by another in silence, which would change the bits of the result.
    if (status == UMFPACK_ERROR_out_of_memory || refused) {
      if (my.symbolic) umfpack_dl_free_symbolic(&my.symbolic);
      my.symbolic = nullptr;
      throw OutOfMemory(fmt::format("the symbolic analysis of {} unknowns does not fit", a.size()));
    }
    if (status < 0)
      throw ConvergenceError(fmt::format("sparse factorisation: symbolic analysis failed (UMFPACK status {})", status),
                             "a smaller time step, and check the materials");
    my.expect_memory(info);
  }
  discard();
  my.require_memory(a.size());
  start_dense_threads();
  const auto status = umfpack_dl_numeric(offsets, rows, a.values.data(), my.symbolic, &my.numeric, my.control, info);
  if (status == UMFPACK_ERROR_out_of_memory) {
    discard();
    throw OutOfMemory(my.asked(a.size()));
  }
  if (status != UMFPACK_OK) {
    discard();
    throw ConvergenceError(
        fmt::format("sparse factorisation: the matrix is singular or holds NaN (UMFPACK status {})", status),
        "a smaller time step, and check the materials");
  }
  my.lower = info[UMFPACK_LNZ];
  my.upper = info[UMFPACK_UNZ];
  my.integer_work.resize(static_cast<std::size_t>(a.size()));
  if (!(my.least_pivot(a) >= trusted_pivot) && !my.solves_known(a)) my.doubtful = a;
  if (my.wants_single && my.doubtful.offsets.empty()) my.shorten(a);
  if (my.numeric) my.work.resize(static_cast<std::size_t>(a.size()) * 5);
}

void DirectSolver::solve(const SparseMatrix& a, const std::vector<double>& b, std::vector<double>& x,
                         double tolerance) const {
  const OneDenseThread same_bits_for_any_number;
  const auto& my = *implementation_;
  assert(factorised() && static_cast<std::int64_t>(b.size()) == a.size());
  if (!my.single.empty()) return my.single.solve(b, tolerance, x);
  my.solve_once(a, b, x);
  if (!my.doubtful.offsets.empty()) my.require_determined(b, x);
}

long long DirectSolver::factor_nonzeros() const {
  return static_cast<long long>(implementation_->lower + implementation_->upper);
}

bool DirectSolver::in_single_precision() const {
  return !implementation_->single.empty();
}

double DirectSolver::bytes() const {
  return in_single_precision() ? static_cast<double>(implementation_->single.bytes())
                               : 16.0 * static_cast<double>(factor_nonzeros());
}

}  // namespace fsi
