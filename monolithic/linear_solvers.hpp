#pragma once

#include <memory>
#include <string>

#include "case/case.hpp"
#include "linear/interface/linear_solver.hpp"

namespace fsi {

/// The three checks below are for users of the paper's coupled system ([Langer2018], section 3.4).
/// \param what  entry of the case, or option, that asks for it, for the message
/// \throws InputError when layers of the wall have pressures of their own where they meet
void refuse_pressures_per_layer(const Case& setup, const PartNodes& wall, const std::string& what);

/// \param fluid, wall  null: no nodes with axes of their own
/// \throws InputError when vectors of some nodes have components along axes of their own, as on planes of symmetry that
/// are normal to no axis
template <int n>
void refuse_turned_frames(const Case& setup, const NodalFrames<n>* fluid, const NodalFrames<n>* wall,
                          const std::string& what);

/// \throws InputError when the case's mesh motion is not linear
void refuse_nonlinear_mesh_motion(const Case& setup, const std::string& what);

/// Makes the linear solver `name`, one of linear_solver_names() ([Langer2018], section 4; docs/guide/solvers.md), with
/// the settings of the case's [monolithic] and [linear]:
///   fast                            the default for users, see FastSolver
///   direct                          sparse factorisation
///   petsc                           a solver of PETSc, where the build has it
///   diagonal lower upper ssor ilu   GMRES with a block preconditioner, one multigrid cycle for each sub-problem's
///                                   inverse; with _exact at the end of the name, factorisations
///   amg amli                        cycles of the coupled multigrid, alone; with _gmres or _fgmres, inside these
/// \throws InputError for an unknown name, and for "petsc" in a build without it. A block preconditioner or the coupled
/// multigrid also throws on several processes, for a linear.preconditioner other than the default, in a scene of one
/// medium, and by the checks above
template <int n>
std::unique_ptr<LinearSolver> make_linear_solver(const std::string& name, const Case& setup,
                                                 const JacobianBlocks<n>& blocks);

}  // namespace fsi
