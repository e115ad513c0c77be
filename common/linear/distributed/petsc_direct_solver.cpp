#include "linear/distributed/petsc_direct_solver.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/vector_operations.hpp"
#include "fem/dimensions.hpp"
#include "linear/direct/direct_solver.hpp"
#include "linear/interface/direct_linear_solver.hpp"

namespace fsi {

namespace {

/// What is left of the residual where factors are no good: the matrix is singular, as nearly as its numbers can tell.
constexpr double singular_residual = 1e-4;

/// Of a system's unknowns in their local numbers.
struct GlobalBuilder {
  const Numbering& numbering;
  PetscGatheredMatrix::Builder terms;

  void add(std::int64_t row, std::int64_t column, const double* number, double factor) {
    terms.add(numbering.first + row, numbering.global(column), number, factor);
  }
};

}  // namespace

template <int n>
PetscDirectSolver<n>::PetscDirectSolver(const JacobianBlocks<n>& blocks)
    : blocks_(blocks), communicator_(petsc_communicator(*blocks.numbering.processes)), jacobian_(blocks) {
  const auto size = static_cast<PetscInt>(blocks.numbering.size);
  b_ = petsc_vector(communicator_, size);
  x_ = petsc_vector(communicator_, size);
}

template <int n>
PetscGatheredMatrix PetscDirectSolver<n>::gather() const {
  const Numbering& numbering = blocks_.numbering;
  GlobalBuilder builder{numbering, {}};
  gather_jacobian_blocks(builder, blocks_);
  return {communicator_, static_cast<PetscInt>(numbering.size), std::move(builder.terms)};
}

template <int n>
void PetscDirectSolver<n>::update() {
  const OneDenseThread same_bits_for_any_number;
  if (matrix_.matrix() == nullptr || gathered_ != blocks_.numbering.version) {
    factors_.reset();
    matrix_ = gather();
    gathered_ = blocks_.numbering.version;
  }
  matrix_.update();
  factors_ = petsc_factorisation(communicator_, matrix_.matrix(), std::move(factors_));
}

template <int n>
LinearReport PetscDirectSolver<n>::solve(const std::vector<double>& b, double, std::vector<double>& x) {
  const OneDenseThread same_bits_for_any_number;
  const Numbering& numbering = blocks_.numbering;
  LinearReport report;
  double* to = nullptr;
  petsc_check(VecGetArray(b_, &to));
  std::copy(b.begin(), b.end(), to);
  petsc_check(VecRestoreArray(b_, &to));
  petsc_check(KSPSolve(factors_, b_, x_));
  x.assign(numbering.columns(), 0.0);
  const double* found = nullptr;
  petsc_check(VecGetArrayRead(x_, &found));
  std::copy_n(found, numbering.size, x.begin());
  petsc_check(VecRestoreArrayRead(x_, &found));
  numbering.update_ghosts(x);
  jacobian_.multiply(x, product_);
  for (std::size_t i = 0; i < b.size(); ++i) product_[i] = b[i] - product_[i];
  double squares[2] = {dot(product_, product_), dot(b, b)};
  numbering.processes->sum(squares, 2);
  report.relative_residual = squares[1] > 0 ? std::sqrt(squares[0] / squares[1]) : 0;
  report.converged = report.relative_residual <= singular_residual;  // false for NaN
  if (!report.converged)
    report.failure =
        fmt::format("the factorised matrix is singular to working precision: a relative residual of {:.1e}",
                    report.relative_residual);
  return report;
}

template <int n>
LinearStatistics PetscDirectSolver<n>::statistics() const {
  LinearStatistics s;
  double bytes = petsc_bytes(matrix_.matrix());
  if (factors_) {
    PC pc = nullptr;
    Mat factors = nullptr;
    petsc_check(KSPGetPC(factors_, &pc));
    petsc_check(PCFactorGetMatrix(pc, &factors));
    MatInfo info;
    petsc_check(MatGetInfo(factors, MAT_LOCAL, &info));
    bytes += 8 * info.nz_used;
  }
  s.memory_mib = bytes / (1 << 20);
  return s;
}

#define FSI_INSTANTIATE(n) template class PetscDirectSolver<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
