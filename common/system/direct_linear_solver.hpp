#pragma once

#include <utility>
#include <vector>

#include "algebra/direct_solver.hpp"
#include "algebra/gathered_matrix.hpp"
#include "fem/gather_blocks.hpp"
#include "system/linear_solver.hpp"

namespace fsi {

/// Gathers the Jacobian in the unknowns of its numbering.
template <class Element>
GatheredMatrix gather_jacobian(const JacobianBlocks<Element>& blocks) {
  const Numbering& numbering = blocks.numbering;
  GatheredMatrix::Builder builder(numbering.size);
  if (blocks.wall) gather_blocks(builder, *blocks.wall, numbering.wall_rows, numbering.wall);
  if (blocks.flow) gather_blocks(builder, *blocks.flow, numbering.flow_rows, numbering.flow);
  if (blocks.shape_derivatives) gather_blocks(builder, *blocks.shape_derivatives, numbering.flow_rows, numbering.mesh);
  if (blocks.mesh_laplacian)
    gather_diagonal_blocks(builder, *blocks.mesh_laplacian, numbering.mesh_rows, numbering.mesh);
  return GatheredMatrix(std::move(builder));
}

/// `direct`: sparse LU factorisation of the Jacobian. On the interface it works with one unknown, as the numbering
/// does.
template <class Element>
class DirectLinearSolver : public LinearSolver {
 public:
  explicit DirectLinearSolver(const JacobianBlocks<Element>& blocks, const DirectSolver::Options& options = {})
      : blocks_(blocks), options_(options), solver_(options) {}

  void update() override {
    if (matrix_.matrix().size() <= 0 || gathered_ != blocks_.numbering.version) {
      matrix_ = gather_jacobian(blocks_);
      gathered_ = blocks_.numbering.version;
      solver_ = DirectSolver(options_);
    }
    matrix_.update();
    solver_.factorise(matrix_.matrix());
  }
  const char* preparation() const override { return "factorisation"; }
  bool ready() const override { return solver_.factorised(); }

  LinearReport solve(const std::vector<double>& b, double, std::vector<double>& x) override {
    solver_.solve(matrix_.matrix(), b, x);
    return {};
  }

  double keep_contraction() const override { return 0.4; }

  LinearStatistics statistics() const override {
    LinearStatistics s;
    s.memory_mib = (16.0 * solver_.factor_nonzeros() + 24.0 * matrix_.matrix().nonzeros()) / (1 << 20);
    return s;
  }

  const SparseMatrix& matrix() const { return matrix_.matrix(); }
  long long factor_nonzeros() const { return solver_.factor_nonzeros(); }

 private:
  JacobianBlocks<Element> blocks_;
  DirectSolver::Options options_;
  GatheredMatrix matrix_;
  int gathered_ = 0;  ///< version of the numbering whose factors it holds
  DirectSolver solver_;
};

}  // namespace fsi
