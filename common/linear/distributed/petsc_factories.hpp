#pragma once

#include <memory>

#include "case/fast_options.hpp"
#include "linear/interface/linear_solver.hpp"

namespace fsi {

/// Whether this build has PETSc.
bool has_petsc();

/// `petsc`: PETSc's iteration with the field-split preconditioner, of as many processes as share out the blocks' numbering.
/// \throws InputError in a build without PETSc
template <int n>
std::unique_ptr<LinearSolver> make_petsc_solver(const JacobianBlocks<n>& blocks, const FastOptions& fast);

/// A factorisation by MUMPS. \throws InputError likewise
template <int n>
std::unique_ptr<LinearSolver> make_petsc_direct_solver(const JacobianBlocks<n>& blocks);

}  // namespace fsi
