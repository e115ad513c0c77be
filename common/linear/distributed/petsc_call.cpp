#include "linear/distributed/petsc_call.hpp"

namespace fsi {

namespace {

std::string last_message;

PetscErrorCode remember(MPI_Comm, int, const char*, const char*, PetscErrorCode code, PetscErrorType type,
                        const char* message, void*) {
  if (type == PETSC_ERROR_INITIAL) last_message = message != nullptr ? message : "";
  return code;
}

/// MPI calls this when it ends, before anything of it is gone.
int end_petsc(MPI_Comm, int, void*, void*) {
  PetscFinalize();
  return MPI_SUCCESS;
}

}  // namespace

void begin_petsc() {
  PetscBool begun = PETSC_FALSE;
  PetscInitialized(&begun);
  if (begun) return;
  ProcessGroup::require_mpi();
  // Signals are the driver's, and options the case's alone.
  for (const char* option : {"-no_signal_handler", "-skip_petscrc"}) PetscOptionsSetValue(nullptr, option, nullptr);
  PetscOptionsSetValue(nullptr, "-options_left", "no");
  // Galerkin products of multigrid. PETSc's own way adds what two other processes send in the order in which it comes.
  if (Communicator::world().size() > 2) PetscOptionsSetValue(nullptr, "-matptap_via", "backend");
  petsc_check(PetscInitializeNoArguments());
  petsc_check(PetscPushErrorHandler(remember, nullptr));
  int key = MPI_KEYVAL_INVALID;
  MPI_Comm_create_keyval(MPI_COMM_NULL_COPY_FN, end_petsc, &key, nullptr);
  MPI_Comm_set_attr(MPI_COMM_SELF, key, nullptr);
}

void petsc_check(PetscErrorCode code) {
  if (code == 0) return;
  const char* text = nullptr;
  if (last_message.empty()) PetscErrorMessage(code, &text, nullptr);
  std::string message = text != nullptr ? text : last_message;
  last_message.clear();
  if (message.empty()) message = "error " + std::to_string(code);
  throw PetscFailure("PETSc: " + message);
}

MPI_Comm petsc_communicator(const Communicator& processes) {
  begin_petsc();
  return mpi_of(processes);
}

OwnedVec petsc_view(MPI_Comm communicator, PetscInt entries) {
  OwnedVec view;
  int size = 1;
  MPI_Comm_size(communicator, &size);
  petsc_check(size == 1 ? VecCreateSeqWithArray(communicator, 1, entries, nullptr, view.fresh())
                        : VecCreateMPIWithArray(communicator, 1, entries, PETSC_DECIDE, nullptr, view.fresh()));
  return view;
}

OwnedVec petsc_vector(MPI_Comm communicator, PetscInt entries) {
  OwnedVec vector;
  petsc_check(VecCreate(communicator, vector.fresh()));
  petsc_check(VecSetSizes(vector, entries, PETSC_DECIDE));
  petsc_check(VecSetType(vector, VECSTANDARD));
  return vector;
}

double petsc_bytes(Mat matrix) {
  if (matrix == nullptr) return 0;
  MatInfo info;
  petsc_check(MatGetInfo(matrix, MAT_LOCAL, &info));
  return info.memory > 0 ? info.memory : 12 * info.nz_allocated;
}

}  // namespace fsi
