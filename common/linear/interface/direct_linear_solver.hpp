#pragma once

#include <utility>
#include <vector>

#include "fem/gather_blocks.hpp"
#include "linear/direct/direct_solver.hpp"
#include "linear/direct/gathered_matrix.hpp"
#include "linear/interface/linear_solver.hpp"

namespace fsi {

/// Adds all blocks of a Jacobian to a system matrix.
/// \param builder  has add(row, column, number, factor) for equations and unknowns of the numbering
template <int n, class Builder>
void gather_jacobian_blocks(Builder& builder, const JacobianBlocks<n>& blocks) {
  const Numbering& numbering = blocks.numbering;
  if (blocks.wall) gather_blocks(builder, *blocks.wall, numbering.wall_rows, numbering.wall);
  if (blocks.fluid) gather_blocks(builder, *blocks.fluid, numbering.fluid_rows, numbering.fluid);
  if (blocks.shape_derivatives) gather_blocks(builder, *blocks.shape_derivatives, numbering.fluid_rows, numbering.mesh);
  if (blocks.mesh_tangent) gather_blocks(builder, *blocks.mesh_tangent, numbering.mesh_rows, numbering.mesh);
  if (blocks.mesh_laplacian)
    gather_diagonal_blocks(builder, *blocks.mesh_laplacian, numbering.mesh_rows, numbering.mesh, blocks.fluid_frames);
}

/// Gathers the Jacobian in the unknowns of its numbering.
template <int n>
GatheredMatrix gather_jacobian(const JacobianBlocks<n>& blocks);

/// `direct` on one process: sparse LU factorisation of the Jacobian. `fast` solves small systems by it, with factors in
/// single precision where the options ask for them.
template <int n>
class DirectLinearSolver : public LinearSolver {
 public:
  explicit DirectLinearSolver(const JacobianBlocks<n>& blocks, const DirectSolver::Options& options = {});

  void update() override;
  const char* preparation() override { return "factorisation"; }
  bool ready() const override { return solver_.factorised(); }

  LinearReport solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) override;

  double keep_contraction() const override { return 0.4; }

  LinearStatistics statistics() const override;

  const SparseMatrix& matrix() const { return matrix_.matrix(); }
  long long factor_nonzeros() const { return solver_.factor_nonzeros(); }

 private:
  JacobianBlocks<n> blocks_;
  DirectSolver::Options options_;
  GatheredMatrix matrix_;
  int gathered_ = 0;  ///< Numbering::version that the matrix was gathered with
  DirectSolver solver_;
};

}  // namespace fsi
