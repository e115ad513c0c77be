#pragma once

#include <petscksp.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "parallel/communicator.hpp"
#include "parallel/mpi_handle.hpp"

namespace fsi {

/// What PETSc refused, in its words.
class PetscFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Begins PETSc, and MPI where that has not happened; PETSc ends with MPI. To be called before anything of it is made.
void begin_petsc();

/// Around each call of PETSc. \throws PetscFailure with PETSc's message
void petsc_check(PetscErrorCode code);

/// Of the processes that solve together; begins PETSc.
MPI_Comm petsc_communicator(const Communicator& processes);

/// An object of PETSc, destroyed with its owner.
template <class Object, PetscErrorCode (*destroy)(Object*)>
class PetscOwned {
 public:
  PetscOwned() = default;
  PetscOwned(PetscOwned&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  PetscOwned& operator=(PetscOwned&& other) noexcept {
    if (this != &other) {
      reset();
      object_ = std::exchange(other.object_, nullptr);
    }
    return *this;
  }
  ~PetscOwned() { reset(); }

  operator Object() const { return object_; }
  /// For functions that make one. The last is destroyed.
  Object* fresh() {
    reset();
    return &object_;
  }
  /// For functions that fill the one at hand, or make one.
  Object* at() { return &object_; }
  explicit operator bool() const { return object_ != nullptr; }

  void reset() {
    PetscBool ended = PETSC_FALSE;
    PetscFinalized(&ended);
    if (object_ != nullptr && !ended) destroy(&object_);
    object_ = nullptr;
  }

 private:
  Object object_ = nullptr;
};

using OwnedMat = PetscOwned<Mat, MatDestroy>;
using OwnedVec = PetscOwned<Vec, VecDestroy>;
using OwnedKsp = PetscOwned<KSP, KSPDestroy>;
using OwnedScatter = PetscOwned<VecScatter, VecScatterDestroy>;

/// A vector with this many entries on this process and no numbers of its own: PlacedArray gives it some.
OwnedVec petsc_view(MPI_Comm communicator, PetscInt entries);
/// A vector with this many entries on this process.
OwnedVec petsc_vector(MPI_Comm communicator, PetscInt entries);

/// Puts an array under a view for as long as this lives.
class PlacedArray {
 public:
  PlacedArray(Vec view, const double* array) : view_(view) { petsc_check(VecPlaceArray(view, array)); }
  ~PlacedArray() { VecResetArray(view_); }
  PlacedArray(const PlacedArray&) = delete;
  PlacedArray& operator=(const PlacedArray&) = delete;

 private:
  Vec view_;
};

/// Memory of a matrix on this process, bytes.
double petsc_bytes(Mat matrix);

}  // namespace fsi
