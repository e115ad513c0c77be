#include "system/direct_linear_solver.hpp"

#include <utility>

#include "fem/elements.hpp"
#include "fem/gather_blocks.hpp"

namespace fsi {

template <class Element>
GatheredMatrix gather_jacobian(const JacobianBlocks<Element>& blocks) {
  const Numbering& numbering = blocks.numbering;
  GatheredMatrix::Builder builder(numbering.size);
  if (blocks.wall) gather_blocks(builder, *blocks.wall, numbering.wall_rows, numbering.wall);
  if (blocks.fluid) gather_blocks(builder, *blocks.fluid, numbering.fluid_rows, numbering.fluid);
  if (blocks.shape_derivatives) gather_blocks(builder, *blocks.shape_derivatives, numbering.fluid_rows, numbering.mesh);
  if (blocks.mesh_laplacian)
    gather_diagonal_blocks(builder, *blocks.mesh_laplacian, numbering.mesh_rows, numbering.mesh);
  return GatheredMatrix(std::move(builder));
}

template <class Element>
DirectLinearSolver<Element>::DirectLinearSolver(const JacobianBlocks<Element>& blocks,
                                                const DirectSolver::Options& options)
    : blocks_(blocks), options_(options), solver_(options) {}

template <class Element>
void DirectLinearSolver<Element>::update() {
  if (matrix_.matrix().size() <= 0 || gathered_ != blocks_.numbering.version) {
    matrix_ = gather_jacobian(blocks_);
    gathered_ = blocks_.numbering.version;
    solver_ = DirectSolver(options_);
  }
  matrix_.update();
  solver_.factorise(matrix_.matrix());
}

template <class Element>
LinearReport DirectLinearSolver<Element>::solve(const std::vector<double>& b, double, std::vector<double>& x) {
  solver_.solve(matrix_.matrix(), b, x);
  return {};
}

template <class Element>
LinearStatistics DirectLinearSolver<Element>::statistics() const {
  LinearStatistics s;
  s.memory_mib = (16.0 * solver_.factor_nonzeros() + 24.0 * matrix_.matrix().nonzeros()) / (1 << 20);
  return s;
}

#define FSI_INSTANTIATE(Element)                                           \
  template GatheredMatrix gather_jacobian(const JacobianBlocks<Element>&); \
  template class DirectLinearSolver<Element>;
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)

}  // namespace fsi
