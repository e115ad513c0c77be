#include "monolithic/linear_solvers.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/error.hpp"
#include "fem/dimensions.hpp"
#include "linear/choice/general_solvers.hpp"
#include "monolithic/coupled_solvers/coupled_linear_solver.hpp"

namespace fsi {

namespace {

/// A name's share of the options of a coupled solver; the rest is the case's.
struct CoupledMethod {
  std::string_view name;
  CoupledIteration iteration;
  std::string_view block_preconditioner;  ///< of block_preconditioners(); empty: the coupled cycle
  bool exact = false;                     ///< sub-problem inverses by factorisation
  bool amli = false;
};

using Iteration = CoupledIteration;
constexpr std::array<CoupledMethod, 16> coupled_methods{{
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
}};
static_assert(names_match(coupled_solver_list, coupled_methods), "case/choices.hpp owns these names");

CoupledSolverOptions options_for(const CoupledMethod& method, const Case& setup) {
  const MultigridData& grid = setup.monolithic.multigrid;
  CoupledSolverOptions options;
  options.iteration = method.iteration;
  options.block_preconditioner = method.block_preconditioner;
  options.krylov = setup.linear.krylov;
  options.smoothing = grid.smoothing;
  options.cycle = grid.cycle;
  if (method.amli) options.cycle.kind = CoupledCycleKind::amli;

  auto& multigrid = options.multigrid;
  multigrid.coarsening = grid.coarsening;
  if (method.exact) multigrid.coarsening.max_levels = 1;
  multigrid.fluid.smoother = grid.sub_problems.fluid_smoother;
  multigrid.wall.smoother = grid.sub_problems.wall_smoother;
  for (auto* cycle : {&multigrid.mesh.cycle, &multigrid.fluid.cycle, &multigrid.wall.cycle}) {
    cycle->kind = grid.sub_problems.kind;
    cycle->pre_smoothing = cycle->post_smoothing = grid.sub_problems.smoothing;
  }
  return options;
}

}  // namespace

void refuse_pressures_per_layer(const Case& setup, const PartNodes& wall, const std::string& what) {
  if (wall.has_copies())
    throw InputError(setup.path.string(), "structure.layer_pressure",
                     "\"separate\" does not go with " + what +
                         ": the paper's coupled system has one wall pressure where layers meet",
                     "set it to \"continuous\", or use the linear solvers " + one_of(general_solver_names()));
}

void refuse_nonlinear_mesh_motion(const Case& setup, const std::string& what) {
  if (setup.mesh_motion.method == MeshMotionMethod::nonlinear_elastic)
    throw InputError(
        setup.path.string(), "mesh_motion.method",
        "\"nonlinear-elastic\" does not go with " + what + ": the paper's coupled system has a harmonic mesh motion",
        "set it to \"harmonic\" or \"stiffened\", or use the linear solvers " + one_of(general_solver_names()));
}

template <int n>
void refuse_turned_frames(const Case& setup, const NodalFrames<n>* fluid, const NodalFrames<n>* wall,
                          const std::string& what) {
  for (const auto* frames : {fluid, wall})
    if (frames && !frames->empty())
      throw InputError(setup.path.string(), "mesh",
                       "a plane of symmetry that is normal to no axis does not go with " + what +
                           ": the paper's coupled system knows components along the axes only",
                       "turn the mesh so that its planes are normal to axes, or use the linear solvers " +
                           one_of(general_solver_names()));
}

template <int n>
std::unique_ptr<LinearSolver> make_linear_solver(const std::string& name, const Case& setup,
                                                 const JacobianBlocks<n>& blocks) {
  const auto known = linear_solver_names();
  if (std::find(known.begin(), known.end(), name) == known.end()) refuse_name("monolithic.linear_solver", name, known);
  for (const auto& method : coupled_methods) {
    if (method.name != name) continue;
    const std::string what = "monolithic.linear_solver = \"" + name + "\"";
    if (!blocks.numbering.processes->is_alone())
      throw InputError(setup.path.string(), "monolithic.linear_solver", "\"" + name + "\" works on one process",
                       "start the program without mpirun, or give " + one_of(general_solver_names()));
    refuse_preconditioner(setup.linear.fast, "\"" + name + "\"");
    if (blocks.mesh_tangent) refuse_nonlinear_mesh_motion(setup, what);
    if (!blocks.coupled()) break;  // not for one medium: the message comes below
    refuse_pressures_per_layer(setup, *blocks.wall_nodes, what);
    refuse_turned_frames<n>(setup, blocks.fluid_frames, blocks.wall_frames, what);
    return std::make_unique<CoupledLinearSolver<n>>(blocks, options_for(method, setup));
  }
  return make_fast_or_direct(name, setup, blocks);
}

#define FSI_INSTANTIATE(n)                                                                                           \
  template void refuse_turned_frames(const Case&, const NodalFrames<n>*, const NodalFrames<n>*, const std::string&); \
  template std::unique_ptr<LinearSolver> make_linear_solver(const std::string&, const Case&, const JacobianBlocks<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
