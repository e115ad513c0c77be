#pragma once

#include <memory>
#include <vector>

#include "case/fast_options.hpp"
#include "linear/interface/linear_solver.hpp"

namespace fsi {

/// `petsc`: what FastSolver does, with matrices, Krylov method and preconditioners of PETSc, on any number of processes.
/// The outer iteration is the same (CondensedIteration). The inner one is FGMRES for F = [A G; B C] of velocities and
/// pressures with the block preconditioner
///   p = S^-1 (r_p - B D^-1 r_v),  v = A^-1 (r_v - G p),
/// A^-1 by PetscMomentumSolver. A small S (SolverPolicy) is factorised whole by each process; else S^-1 is a cycle of
/// algebraic multigrid. What defeats it gets more sweeps and coarse levels, then a factorisation by MUMPS. Options:
/// [petsc] options of the case, see petsc_options.hpp.
template <int n>
class PetscSolver : public LinearSolver {
 public:
  explicit PetscSolver(const JacobianBlocks<n>& blocks, const FastOptions& options = {});
  ~PetscSolver() override;

  bool ready() const override { return ready_; }
  /// What a failure led to is forgotten here, as by FastSolver.
  /// \throws InputError for [petsc] options that PETSc does not take, ConvergenceError for other failures of PETSc
  void update() override;
  LinearReport solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) override;
  LinearReport try_to_solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) override;
  double keep_contraction() const override;
  LinearStatistics statistics() const override;

  /// The iteration failed on the last Jacobian, which is factorised.
  bool uses_factorisation() const { return direct_ != nullptr; }

 private:
  struct Iterative;

  /// \param strong  more sweeps, and coarse levels for the wall however stiff it is
  void set_up_preconditioner(bool strong);
  LinearReport solve(const std::vector<double>& b, double tolerance, std::vector<double>& x, bool may_factorise);

  JacobianBlocks<n> blocks_;
  FastOptions options_;
  std::unique_ptr<Iterative> iterative_;
  std::unique_ptr<LinearSolver> direct_;
  bool ready_ = false;
  bool strengthened_ = false;
};

}  // namespace fsi
