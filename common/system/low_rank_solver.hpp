#pragma once

#include <memory>
#include <vector>

#include "system/jacobian_product.hpp"
#include "system/linear_solver.hpp"

namespace fsi {

/// slope w w^T, joining the fluid's block of a Jacobian: how the pressure at an opening answers the flow there. Where the
/// opening moves, the flow depends on the mesh, too: slope w (w, dQ/dd_m)^T.
struct OpeningTerm {
  const std::vector<double>* normals = nullptr;  ///< w, as a flow array along the axes of space, mm^2
  double slope = 0;                              ///< dp/dQ, kPa ms/mm^3
  const std::vector<double>* by_mesh = nullptr;  ///< dQ/dd_m, vector layout, mm^2/ms; null: the opening stays
};

/// Solves with A + sum of slope w v^T by any solver for A, after Sherman, Morrison and Woodbury ([Golub2013]):
///   x = z - Y (1 + S V^T Y)^-1 S V^T z,   A z = b,   A Y = W.
/// Y is found with the first solve after an update() and serves as long as what A's solver has prepared. So the matrix
/// stays as sparse as it was, and Newton's method keeps its convergence. Solutions of iterative solvers are corrected
/// until the residual of the whole is as small as demanded.
template <int n>
class LowRankLinearSolver : public LinearSolver {
 public:
  /// \param blocks  of A
  /// \param terms   not owned; slopes may differ at each update()
  LowRankLinearSolver(const JacobianBlocks<n>& blocks, std::unique_ptr<LinearSolver> solver,
                      const std::vector<OpeningTerm>& terms);

  void update() override;
  const char* preparation() const override { return solver_->preparation(); }
  bool ready() const override { return solver_->ready(); }
  LinearReport solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) override;
  LinearStatistics statistics() const override;
  double keep_contraction() const override { return solver_->keep_contraction(); }
  int solves_worth_an_update() const override {
    return solver_->solves_worth_an_update() + static_cast<int>(terms_.size());
  }

 private:
  /// A term in the unknowns of the numbering.
  struct Term {
    double slope;
    std::vector<double> rows, columns, solution;  ///< w as equations, v as own unknowns; A^-1 w
  };

  /// Finds A^-1 w of all terms. \returns what went wrong, of the first that did
  LinearReport prepare();
  /// z - Y (1 + S V^T Y)^-1 S V^T z
  void correct(std::vector<double>& z) const;
  /// |b - (A + sum) x|; leaves b - (A + sum) x in residual_.
  double residual_norm(const std::vector<double>& b, std::vector<double>& x);
  /// Of all terms W^T x, summed over processes.
  std::vector<double> flows(const std::vector<double>& x) const;
  double norm_of(const std::vector<double>& equations) const;

  JacobianBlocks<n> blocks_;
  std::unique_ptr<LinearSolver> solver_;
  const std::vector<OpeningTerm>& terms_;
  JacobianProduct<n> product_;
  std::vector<Term> of_system_;
  std::vector<double> inverse_;  ///< of 1 + S V^T Y, row by row
  bool prepared_ = false;
  int preparing_iterations_ = 0;
  std::vector<double> residual_, correction_;
};

}  // namespace fsi
