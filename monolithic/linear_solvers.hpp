#pragma once

#include <memory>
#include <string>

#include "case/case.hpp"
#include "linear/interface/linear_solver.hpp"

namespace fsi {

/// For all that works on the paper's coupled system. \param what  asks for it: an entry of the case or an option
/// \throws InputError when layers of the wall have pressures of their own where they meet
void refuse_pressures_per_layer(const Case& setup, const PartNodes& wall, const std::string& what);

/// For the same. \throws InputError when vectors of some nodes are counted along axes of their own, as on planes of
/// symmetry that are normal to no axis
template <int n>
void refuse_turned_frames(const Case& setup, const NodalFrames<n>* fluid, const NodalFrames<n>* wall,
                          const std::string& what);

/// For the same. \throws InputError when the case's mesh motion is not linear
void refuse_nonlinear_mesh_motion(const Case& setup, const std::string& what);

/// Makes the linear solver `name`, one of linear_solver_names() ([Langer2018], section 4; docs/guide/solvers.md), with the
/// settings of the case's [monolithic] and [linear]:
///   fast                            what a user should run, see FastSolver
///   direct                          sparse factorisation
///   diagonal lower upper ssor ilu   GMRES with a block preconditioner, one multigrid cycle for each sub-problem's
///                                   inverse; with _exact at the end of the name, factorisations
///   amg amli                        cycles of the coupled multigrid, alone; with _gmres or _fgmres, inside these
/// \throws InputError when the solver needs fluid and wall and the scene has one alone, or when it needs one wall
/// pressure where layers meet and they have their own, planes of symmetry normal to axes, or a linear mesh motion
template <int n>
std::unique_ptr<LinearSolver> make_linear_solver(const std::string& name, const Case& setup,
                                                 const JacobianBlocks<n>& blocks);

}  // namespace fsi
