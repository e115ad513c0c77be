#pragma once

#include "base/name_table.hpp"
#include "case/multigrid_kinds.hpp"

namespace fsi {

// Options of the coupled multigrid in monolithic/ ([Langer2018]), here so that case files can set them.

struct CoupledCoarseningOptions {
  CoarseningKind kind = CoarseningKind::colouring;
  int max_levels = 10;
  int coarsest_nodes = 400;  ///< fluid and wall nodes, at most, of the level that is solved directly
};

/// Steps of the coupled smoother and their damping.
struct CoupledSmoothingOptions {
  int pre_smoothing = 5, post_smoothing = 5;
  double damping = 0;         ///< omega_f = omega_s; 0: damping_for() the estimated largest eigenvalue, level by level
  double mesh_damping = 1;    ///< omega_m; mesh motion is not in the loop that makes the iteration diverge
  int power_iterations = 12;  ///< of the estimate
  double safety = 0.95;       ///< factor on the estimated damping: too large does more harm than too small
};

/// How the cycle visits the coarse levels.
enum class CoupledCycleKind {
  v,    ///< once
  w,    ///< twice (algorithm 3 with nu = 2)
  k,    ///< as preconditioner of FGMRES, a second iteration only where the first one left much of the residual
  amli  ///< as preconditioner of nu = 2 iterations of FGMRES (algorithm 4)
};
/// "v", "w", "k"; amli has linear solvers of its own
const NameTable<CoupledCycleKind>& coupled_cycle_kinds();

struct CoupledCycleOptions {
  CoupledCycleKind kind = CoupledCycleKind::w;
  double k_cycle_reduction =
      0.25;  ///< the K-cycle's second iteration is skipped when the first reduced the residual more
};

/// The sub-problems' multigrid within a coupled method; all else is as sub_problem_options.hpp has it.
struct SubProblemCycleOptions {
  SaddleSmootherKind fluid_smoother = SaddleSmootherKind::braess_sarazin;
  SaddleSmootherKind wall_smoother = SaddleSmootherKind::braess_sarazin;
  CycleKind kind = CycleKind::w;  ///< v or w: a K-cycle is no linear map, as GMRES needs one
  int smoothing = 2;              ///< steps before and after the coarse correction
};

}  // namespace fsi
