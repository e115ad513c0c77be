#include "system/direct_linear_solver.hpp"

#include <utility>

#include "fem/dimensions.hpp"
#include "fem/gather_blocks.hpp"

namespace fsi {

template <int n>
GatheredMatrix gather_jacobian(const JacobianBlocks<n>& blocks) {
  const Numbering& numbering = blocks.numbering;
  GatheredMatrix::Builder builder(numbering.size);
  if (blocks.wall) gather_blocks(builder, *blocks.wall, numbering.wall_rows, numbering.wall);
  if (blocks.fluid) gather_blocks(builder, *blocks.fluid, numbering.fluid_rows, numbering.fluid);
  if (blocks.shape_derivatives) gather_blocks(builder, *blocks.shape_derivatives, numbering.fluid_rows, numbering.mesh);
  if (blocks.mesh_tangent) gather_blocks(builder, *blocks.mesh_tangent, numbering.mesh_rows, numbering.mesh);
  if (blocks.mesh_laplacian)
    gather_diagonal_blocks(builder, *blocks.mesh_laplacian, numbering.mesh_rows, numbering.mesh, blocks.fluid_frames);
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
LinearReport DirectLinearSolver<n>::solve(const std::vector<double>& b, double, std::vector<double>& x) {
  solver_.solve(matrix_.matrix(), b, x);
  return {};
}

template <int n>
LinearStatistics DirectLinearSolver<n>::statistics() const {
  LinearStatistics s;
  s.memory_mib = (16.0 * solver_.factor_nonzeros() + 24.0 * matrix_.matrix().nonzeros()) / (1 << 20);
  return s;
}

#define FSI_INSTANTIATE(n)                                           \
  template GatheredMatrix gather_jacobian(const JacobianBlocks<n>&); \
  template class DirectLinearSolver<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
