#include "linear/distributed/petsc_factorisation.hpp"

#include <utility>

#include "base/error.hpp"
#include "linear/distributed/petsc_options.hpp"

namespace fsi {

OwnedKsp petsc_factorisation(MPI_Comm communicator, Mat matrix, OwnedKsp old) {
  OwnedKsp ksp = std::move(old);
  const bool first = !ksp;
  PC pc = nullptr;
  if (first) {
    take_petsc_options();
    petsc_check(KSPCreate(communicator, ksp.fresh()));
    petsc_check(KSPSetOptionsPrefix(ksp, prefix_of(PetscPart::direct)));
    petsc_check(KSPSetType(ksp, KSPPREONLY));
    petsc_check(KSPGetPC(ksp, &pc));
    petsc_check(PCSetType(pc, PCLU));
    petsc_check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  }
  petsc_check(KSPGetPC(ksp, &pc));
  petsc_check(KSPSetOperators(ksp, matrix, matrix));
  try {
    if (first) petsc_check(KSPSetFromOptions(ksp));
    petsc_check(KSPSetUp(ksp));
  } catch (const PetscFailure& failure) {
    blame_petsc_options(failure.what());
  }
  if (first) refuse_unread_petsc_options(PetscPart::direct);
  PCFailedReason failed = PC_NOERROR;
  petsc_check(PCGetFailedReason(pc, &failed));
  if (failed != PC_NOERROR)
    throw ConvergenceError(failed == PC_FACTOR_OUTMEMORY
                               ? "sparse factorisation by PETSc: out of memory"
                               : "sparse factorisation by PETSc: the matrix is singular or holds NaN",
                           failed == PC_FACTOR_OUTMEMORY ? "linear_solver = \"petsc\", more processes or a coarser mesh"
                                                         : "a smaller time step or load step");
  return ksp;
}

}  // namespace fsi
