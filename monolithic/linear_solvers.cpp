#include "monolithic/linear_solvers.hpp"

#include <functional>
#include <utility>
#include <vector>

#include "condensed_solver/fast_or_direct.hpp"
#include "fem/p1_axisymmetric_triangle.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "monolithic/coupled_linear_solver.hpp"

namespace fsi {

namespace {

/// A name's share of the options of a coupled solver; the rest is the case's.
struct CoupledMethod {
  std::string name;
  CoupledIteration iteration;
  std::string block_preconditioner;  ///< empty: the coupled cycle
  bool exact = false;                ///< sub-problem inverses by factorisation
  bool amli = false;
};

const std::vector<CoupledMethod>& coupled_methods() {
  using Iteration = CoupledIteration;
  static const std::vector<CoupledMethod> table = {
      {"diagonal", Iteration::gmres, "diagonal"},
      {"lower", Iteration::gmres, "lower"},
      {"upper", Iteration::gmres, "upper"},
      {"ssor", Iteration::gmres, "ssor"},
      {"ilu", Iteration::gmres, "ilu"},
      {"diagonal_exact", Iteration::gmres, "diagonal", true},
      {"lower_exact", Iteration::gmres, "lower", true},
      {"upper_exact", Iteration::gmres, "upper", true},
      {"ssor_exact", Iteration::gmres, "ssor", true},
      {"ilu_exact", Iteration::gmres, "ilu", true},
      {"amg", Iteration::richardson, ""},
      {"amg_gmres", Iteration::gmres, ""},
      {"amg_fgmres", Iteration::fgmres, ""},
      {"amli", Iteration::richardson, "", false, true},
      {"amli_gmres", Iteration::gmres, "", false, true},
      {"amli_fgmres", Iteration::fgmres, "", false, true},
  };
  return table;
}

CoupledCycleKind coupled_cycle_kind(const CoupledMethod& method, const MultigridData& data) {
  if (method.amli) return CoupledCycleKind::amli;
  return data.cycle == "v" ? CoupledCycleKind::v : data.cycle == "k" ? CoupledCycleKind::k : CoupledCycleKind::w;
}

CoupledSolverOptions options_for(const CoupledMethod& method, const MonolithicData& data) {
  const MultigridData& grid = data.multigrid;
  CoupledSolverOptions options;
  options.iteration = method.iteration;
  options.block_preconditioner = method.block_preconditioner;
  options.krylov.max_iterations = data.max_linear_iterations;
  options.krylov.restart = data.krylov_restart;

  auto& multigrid = options.multigrid;
  multigrid.coarsening.kind = coarsening_kind(grid.coarsening);
  multigrid.coarsening.max_levels = method.exact ? 1 : grid.levels;
  multigrid.coarsening.coarsest_nodes = grid.coarsest_nodes;
  multigrid.flow.smoother = saddle_smoother_kind(grid.fluid_smoother);
  multigrid.wall.smoother = saddle_smoother_kind(grid.wall_smoother);
  for (auto* cycle : {&multigrid.mesh.cycle, &multigrid.flow.cycle, &multigrid.wall.cycle}) {
    cycle->kind = cycle_kind(grid.sub_cycle);
    cycle->pre_smoothing = cycle->post_smoothing = grid.sub_smoothing;
  }
  options.smoothing.pre_smoothing = grid.pre_smoothing;
  options.smoothing.post_smoothing = grid.post_smoothing;
  options.smoothing.damping = grid.damping;
  options.cycle.kind = coupled_cycle_kind(method, grid);
  return options;
}

}  // namespace

template <class Element>
std::unique_ptr<LinearSolver> make_linear_solver(const std::string& name, const Case& setup,
                                                 const JacobianBlocks<Element>& blocks) {
  for (const auto& method : coupled_methods()) {
    if (method.name != name) continue;
    if (!blocks.coupled()) break;  // not for one medium: the message comes below
    return std::make_unique<CoupledLinearSolver<Element>>(blocks, options_for(method, setup.monolithic));
  }
  return make_fast_or_direct(name, setup, blocks);
}

template std::unique_ptr<LinearSolver> make_linear_solver(const std::string&, const Case&,
                                                          const JacobianBlocks<P1Tetrahedron>&);
template std::unique_ptr<LinearSolver> make_linear_solver(const std::string&, const Case&,
                                                          const JacobianBlocks<P1AxisymmetricTriangle>&);

}  // namespace fsi
