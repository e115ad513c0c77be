#pragma once

#include <memory>
#include <vector>

#include "linear/interface/jacobian_product.hpp"
#include "linear/interface/linear_solver.hpp"
#include "linear/interface/low_rank_preconditioner.hpp"

namespace fsi {

/// slope w w^T, joining the fluid's block of a Jacobian: how the pressure at an opening answers the flow there. Where the
/// opening moves, the flow depends on the mesh, too: slope w (w, dQ/dd_m)^T.
struct OpeningTerm {
  const std::vector<double>* normals = nullptr;  ///< w, as a flow array along the axes of space, mm^2
  double slope = 0;                              ///< dp/dQ, kPa ms/mm^3
  const std::vector<double>* by_mesh = nullptr;  ///< dQ/dd_m, vector layout, mm^2/ms; null: the opening stays
  /// The flow is given, and the pressure p that drives it is one more unknown, with w as its column and one more equation
  /// v^T x = gap. `slope` is not read.
  bool given = false;
  double gap = 0;  ///< mm^3/ms; may differ at each solve
  /// Where a network joins openings: dp/dQ of this pressure by the flows of all terms, in their order, in place of `slope`.
  /// Its term is then w times the sum of these slopes times v^T of each term. Null: there is no other.
  const std::vector<double>* slopes = nullptr;
};

/// Solves with A + W S V^T, S being the slopes of pressures by flows, by any solver for A, after Sherman, Morrison and Woodbury ([Golub2013]):
///   x = z - Y p,   (1 + S V^T Y) p = S V^T z,   A z = b,   A Y = W.
/// Where a flow is given, its row is v^T Y p = v^T z - gap (block elimination).
/// Y is found with the first solve after an update() and serves as long as what A's solver has prepared. So the matrix
/// stays as sparse as it was, and Newton's method keeps its convergence. Solutions of iterative solvers are corrected
/// until the residual of the whole is as small as demanded, a few times at most; one of up to twice the tolerance is
/// accepted. Their relative residual is over |b| + sum |p| |w|, summed over the terms whose flow is given.
template <int n>
class LowRankLinearSolver : public LinearSolver {
 public:
  /// \param blocks  of A
  /// \param terms   not owned; slopes may differ at each update()
  LowRankLinearSolver(const JacobianBlocks<n>& blocks, std::unique_ptr<LinearSolver> solver,
                      const std::vector<OpeningTerm>& terms);

  /// p of the last solve(), kPa, one per term: the change of an opening's pressure, or, where its flow is given, the
  /// solution for the pressure.
  const std::vector<double>& pressures() const { return pressures_; }

  void update() override;
  const char* preparation() override { return solver_->preparation(); }
  std::string decides() const override { return solver_->decides(); }
  bool ready() const override { return solver_->ready(); }
  LinearReport solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) override;
  LinearStatistics statistics() const override;
  double keep_contraction() const override { return solver_->keep_contraction(); }
  /// Null where a flow is given.
  MediumPreconditioner* medium_preconditioner() override;
  bool is_iterative() const override;

 private:
  /// A term in the unknowns of the numbering.
  struct Term {
    double slope;
    bool given;
    double answer = 0;                            ///< v^T A^-1 w: the flow of its own unit pressure
    double size = 0;                              ///< |w|, where the flow is given
    std::vector<double> slopes;                   ///< by all flows; empty: by its own alone
    std::vector<double> rows, columns, solution;  ///< w as equations, v as own unknowns; A^-1 w
  };

  enum class Effort { no_factorisation, any };  ///< where an iteration fails
  /// Finds A^-1 w of all terms. \returns what went wrong, of the first that did
  LinearReport prepare(Effort effort);
  /// z - Y p. \param gaps  of the terms whose flow is given \returns p
  std::vector<double> correct(std::vector<double>& z, const std::vector<double>& gaps) const;
  /// |b - (A + W S V^T) x - W p|, the latter W p of the terms whose flow is given. Leaves the residual in residual_ and
  /// updates the ghosts in x.
  double residual_norm(const std::vector<double>& b, std::vector<double>& x);
  /// V^T x: the flow of each term, mm^3/ms, summed over processes.
  std::vector<double> flows(const std::vector<double>& x) const;
  double norm_of(const std::vector<double>& equations) const;
  /// What a term's pressure answers to the flows of all terms.
  static double answer(const Term& term, std::size_t place, const std::vector<double>& flows) {
    return pressure_by_flows(term.slope, term.slopes, place, flows);
  }

  JacobianBlocks<n> blocks_;
  std::unique_ptr<LinearSolver> solver_;
  const std::vector<OpeningTerm>& terms_;
  JacobianProduct<n> product_;
  std::vector<Term> of_system_;
  std::vector<double> inverse_;  ///< of 1 + S V^T Y, or V^T Y over its diagonal, row by row
  bool prepared_ = false;
  std::unique_ptr<LowRankPreconditioner> preconditioner_;
  std::vector<double> residual_, correction_, pressures_;
};

}  // namespace fsi
