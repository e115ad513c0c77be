#pragma once

#include <memory>
#include <string>

#include "case/case.hpp"
#include "linear/interface/linear_solver.hpp"

namespace fsi {

/// Whether `name` serves any scene and any sub-problem.
bool is_general_solver(const std::string& name);

/// Refuses a `linear.preconditioner` other than the default where nothing iterates with it.
/// \param where  the solver that is made instead, as error messages name it
/// \throws InputError
void refuse_preconditioner(const FastOptions& fast, const std::string& where);

/// Makes the linear solver `name`, one of general_solver_names(), for a scene or sub-problem of as many processes as
/// share out the blocks' numbering. On several processes MUMPS stands in for the sparse factorisation of "direct", and
/// "petsc" for "fast" where the case has [petsc] options. By all processes together.
/// \throws InputError for another name, for "petsc" in a build without it, and as refuse_preconditioner()
template <int n>
std::unique_ptr<LinearSolver> make_general_solver(const std::string& name, const FastOptions& fast,
                                                  const JacobianBlocks<n>& blocks);

/// Factory of the linear solver `name`.
/// \throws InputError for another name
template <int n>
LinearSolverFactory<n> general_solver_factory(const std::string& name, const FastOptions& fast);

/// make_general_solver() with the options of the case's [linear], for a scene with fluid or wall only.
/// \throws InputError as that, and for a solver of coupled scenes
template <int n>
std::unique_ptr<LinearSolver> make_fast_or_direct(const std::string& name, const Case& setup,
                                                  const JacobianBlocks<n>& blocks);

/// The linear solver that a case names, with the preconditioner of `fast`, for log and summary.
std::string linear_solver_in_words(const std::string& name, const FastOptions& fast, const Communicator& processes);

/// What is taken in place of the linear solver that the case names, a sentence for the user; empty: nothing is.
/// \param fast       options of "fast"
/// \param dimension  of the scene
std::string other_solver_on_processes(const std::string& name, const FastOptions& fast, int dimension,
                                      const Communicator& processes);

}  // namespace fsi
