#pragma once

#include <string>
#include <vector>

namespace fsi {

/// [petsc] options of the case at hand, for all solvers made from now on: PETSc's options are the program's.
/// \param options    as on PETSc's command line: "-fsi_..." with values
/// \param case_file  named in errors
void set_petsc_options(const std::string& options, const std::string& case_file);
/// The case file of the last set_petsc_options(), for errors that name it.
const std::string& case_of_petsc_options();

/// Parts of the solver that read options of their own, by prefix.
enum class PetscPart {
  flow,    ///< -fsi_ but for the others: velocities and pressures
  wall,    ///< -fsi_wall_: coarse levels of a stiff wall's momentum
  mesh,    ///< -fsi_mesh_: mesh motion
  direct,  ///< -fsi_direct_: factorisation
};
/// Without the dash.
const char* prefix_of(PetscPart part);

// take_petsc_options(), refuse_unread_petsc_options() and blame_petsc_options() are in builds with MPI only.

/// Hands the options to PETSc, which must have begun.
void take_petsc_options();
/// \throws InputError for an option of this part that it has not read by now: it does not exist
void refuse_unread_petsc_options(PetscPart part);
/// \throws InputError in the words of a failure that came while options were read, where there are any; otherwise
/// \throws PetscFailure again
[[noreturn]] void blame_petsc_options(const std::string& failure);
bool has_petsc_options();
/// Whether an option of the case begins with - and this prefix. \param prefix  without the dash, as "fsi_pressure_"
bool has_petsc_options(const std::string& prefix);

}  // namespace fsi
