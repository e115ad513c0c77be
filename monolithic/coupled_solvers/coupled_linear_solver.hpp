#pragma once

#include <memory>
#include <string>
#include <vector>

#include "linear/interface/linear_solver.hpp"
#include "linear/krylov/gmres.hpp"
#include "linear/krylov/richardson.hpp"
#include "monolithic/coupled_solvers/multigrid/coupled_multigrid.hpp"

namespace fsi {

/// The iteration around a preconditioner.
enum class CoupledIteration { richardson, gmres, fgmres };

struct CoupledSolverOptions {
  CoupledIteration iteration = CoupledIteration::gmres;
  std::string block_preconditioner;  ///< diagonal, lower, upper, ssor or ilu; empty: the coupled cycle
  KrylovOptions krylov;              ///< the tolerance comes with each solve
  CoupledMultigridOptions multigrid;
  CoupledSmoothingOptions smoothing;
  CoupledCycleOptions cycle;
};

/// Solves the linearised coupled equations in the paper's form K x = b by a preconditioned iteration ([Langer2018],
/// section 4): the tolerance is on its true residual |b - K x| / |b|, rows of all units as assembled.
template <int n>
class CoupledLinearSolver : public LinearSolver {
 public:
  CoupledLinearSolver(const JacobianBlocks<n>& blocks, const CoupledSolverOptions& options);

  void update() override;
  bool ready() const override { return preconditioner_ != nullptr; }

  LinearReport solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) override;

  LinearStatistics statistics() const override;

  const CoupledSystem<n>& system() const { return system_; }

 private:
  void mesh_motion_is_set_up();

  JacobianBlocks<n> blocks_;
  CoupledSolverOptions options_;
  CoupledSystem<n> system_;
  std::unique_ptr<CoupledMultigrid<n>> multigrid_;
  std::unique_ptr<CoupledPreconditioner> preconditioner_;
  Richardson richardson_;
  Gmres gmres_;
  Fgmres fgmres_;
  CoupledVector b_, in_, out_, zero_;
  std::vector<double> flat_b_, flat_x_;
  double cycle_memory_ = 0;
  int set_up_ = 0;  ///< the assembly whose mesh motion is set up
};

}  // namespace fsi
