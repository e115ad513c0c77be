#pragma once

#include "linear/distributed/petsc_call.hpp"

namespace fsi {

/// Factors of a matrix, LU by MUMPS unless the options by the prefix -fsi_direct_ say otherwise. KSPSolve() solves by
/// them.
/// \param old  factors of earlier values of the same pattern, whose analysis serves again; null: none
/// \throws ConvergenceError when the matrix is singular to working precision or holds NaN, or the factors do not fit
/// \throws InputError for -fsi_direct_ options that PETSc does not take
OwnedKsp petsc_factorisation(MPI_Comm communicator, Mat matrix, OwnedKsp old = {});

}  // namespace fsi
