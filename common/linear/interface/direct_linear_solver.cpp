#include "linear/interface/direct_linear_solver.hpp"

#include <utility>

#include "fem/dimensions.hpp"

namespace fsi {

template <int n>
GatheredMatrix gather_jacobian(const JacobianBlocks<n>& blocks) {
  GatheredMatrix::Builder builder(blocks.numbering.size);
  gather_jacobian_blocks(builder, blocks);
  return GatheredMatrix(std::move(builder));
}

template <int n>
DirectLinearSolver<n>::DirectLinearSolver(const JacobianBlocks<n>& blocks, const DirectSolver::Options& options)
    : blocks_(blocks), options_(options), solver_(options) {}

template <int n>
void DirectLinearSolver<n>::update() {
  if (matrix_.matrix().size() <= 0 || gathered_ != blocks_.numbering.version) {
    matrix_ = gather_jacobian(blocks_);
    gathered_ = blocks_.numbering.version;
    solver_ = DirectSolver(options_);
  }
  matrix_.update();
  solver_.factorise(matrix_.matrix());
}

template <int n>
LinearReport DirectLinearSolver<n>::solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) {
  solver_.solve(matrix_.matrix(), b, x, tolerance);
  return {};
}

template <int n>
LinearStatistics DirectLinearSolver<n>::statistics() const {
  LinearStatistics s;
  s.memory_mib = (solver_.bytes() + 24.0 * matrix_.matrix().nonzeros()) / (1 << 20);
  return s;
}

#define FSI_INSTANTIATE(n)                                           \
  template GatheredMatrix gather_jacobian(const JacobianBlocks<n>&); \
  template class DirectLinearSolver<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
