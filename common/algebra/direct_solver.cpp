#include "algebra/direct_solver.hpp"

#include <umfpack.h>

#include <fmt/format.h>

#include <cassert>

#include "base/error.hpp"

extern "C" void openblas_set_num_threads(int);
extern "C" int openblas_get_num_threads();

namespace fsi {

struct DirectSolver::Implementation {
  double control[UMFPACK_CONTROL];
  void* symbolic = nullptr;
  void* numeric = nullptr;
  double lower = 0, upper = 0;
  mutable std::vector<SuiteSparse_long> integer_work;
  mutable std::vector<double> work;

  explicit Implementation(const Options& options) {
    umfpack_dl_defaults(control);
    control[UMFPACK_ORDERING] = options.ordering == "metis"  ? UMFPACK_ORDERING_METIS
                                : options.ordering == "best" ? UMFPACK_ORDERING_BEST
                                                             : UMFPACK_ORDERING_AMD;
    control[UMFPACK_STRATEGY] = options.strategy == "unsymmetric" ? UMFPACK_STRATEGY_UNSYMMETRIC
                                : options.strategy == "symmetric" ? UMFPACK_STRATEGY_SYMMETRIC
                                                                  : UMFPACK_STRATEGY_AUTO;
    control[UMFPACK_IRSTEP] = options.refinement_steps;
  }
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
}  // namespace

DirectSolver::DirectSolver() : DirectSolver(Options{}) {}
DirectSolver::DirectSolver(const Options& options) : implementation_(std::make_unique<Implementation>(options)) {}
DirectSolver::~DirectSolver() = default;
DirectSolver::DirectSolver(DirectSolver&&) noexcept = default;
DirectSolver& DirectSolver::operator=(DirectSolver&&) noexcept = default;

bool DirectSolver::factorised() const {
  return implementation_->numeric != nullptr;
}

void DirectSolver::discard() {
  if (implementation_->numeric) umfpack_dl_free_numeric(&implementation_->numeric);
}

void DirectSolver::factorise(const SparseMatrix& a) {
  const OneDenseThread same_bits_for_any_number;
  auto& my = *implementation_;
  assert(a.rows.size() == a.values.size() && a.offsets.back() == a.nonzeros());
  const auto* offsets = indices(a.offsets);
  const auto* rows = indices(a.rows);
  double info[UMFPACK_INFO];
  if (!my.symbolic) {
    const auto status =
        umfpack_dl_symbolic(a.size(), a.size(), offsets, rows, a.values.data(), &my.symbolic, my.control, info);
    if (status < 0)
      throw ConvergenceError(fmt::format("sparse factorisation: symbolic analysis failed (UMFPACK status {})", status),
                             "a smaller mesh if memory ran out");
  }
  discard();
  const auto status = umfpack_dl_numeric(offsets, rows, a.values.data(), my.symbolic, &my.numeric, my.control, info);
  if (status != UMFPACK_OK) {
    discard();
    throw ConvergenceError(
        status == UMFPACK_ERROR_out_of_memory
            ? "sparse factorisation: out of memory"
            : fmt::format("sparse factorisation: the matrix is singular or holds NaN (UMFPACK status {})", status),
        status == UMFPACK_ERROR_out_of_memory ? "a coarser mesh" : "a smaller time step, and check the materials");
  }
  my.lower = info[UMFPACK_LNZ];
  my.upper = info[UMFPACK_UNZ];
  my.integer_work.resize(static_cast<std::size_t>(a.size()));
  my.work.resize(static_cast<std::size_t>(a.size()) * 5);
}

void DirectSolver::solve(const SparseMatrix& a, const std::vector<double>& b, std::vector<double>& x) const {
  const OneDenseThread same_bits_for_any_number;
  const auto& my = *implementation_;
  assert(my.numeric && static_cast<std::int64_t>(b.size()) == a.size());
  x.resize(b.size());
  double info[UMFPACK_INFO];
  const auto status = umfpack_dl_wsolve(UMFPACK_A, indices(a.offsets), indices(a.rows), a.values.data(), x.data(),
                                        b.data(), my.numeric, my.control, info, my.integer_work.data(), my.work.data());
  if (status != UMFPACK_OK)
    throw ConvergenceError(fmt::format("sparse solve failed (UMFPACK status {})", status), "a smaller time step");
}

void DirectSolver::solve_each(const SparseMatrix& a, const std::vector<std::vector<double>>& b,
                              std::vector<std::vector<double>>& x) const {
  const OneDenseThread same_bits_for_any_number;
  const auto& my = *implementation_;
  const int count = static_cast<int>(b.size());
  x.resize(b.size());
  std::vector<int> status(b.size(), UMFPACK_OK);
#pragma omp parallel for schedule(dynamic) if (a.size() > 2000)
  for (int k = 0; k < count; ++k) {
    x[k].resize(b[k].size());
    std::vector<SuiteSparse_long> integer_work(my.integer_work.size());
    std::vector<double> work(my.work.size());
    double info[UMFPACK_INFO];
    status[k] = static_cast<int>(umfpack_dl_wsolve(UMFPACK_A, indices(a.offsets), indices(a.rows), a.values.data(),
                                                   x[k].data(), b[k].data(), my.numeric, my.control, info,
                                                   integer_work.data(), work.data()));
  }
  for (int s : status)
    if (s != UMFPACK_OK)
      throw ConvergenceError(fmt::format("sparse solve failed (UMFPACK status {})", s), "a smaller time step");
}

long long DirectSolver::factor_nonzeros() const {
  return static_cast<long long>(implementation_->lower + implementation_->upper);
}

void set_dense_threads(int count) {
  openblas_set_num_threads(count);
}

OneDenseThread::OneDenseThread() : before_(openblas_get_num_threads()) {
  set_dense_threads(1);
}
OneDenseThread::~OneDenseThread() {
  set_dense_threads(before_);
}

}  // namespace fsi
