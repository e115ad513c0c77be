#pragma once

#include <vector>

#include "linear/distributed/matrix_arrays.hpp"
#include "linear/distributed/petsc_call.hpp"

namespace fsi {

/// A matrix of PETSc (AIJ) to which a list of numbers is added, straight into PETSc's arrays, at places that are worked
/// out once. A number of the list keeps 4 bytes between two fillings; MatSetPreallocationCOO keeps 16 and wants the
/// numbers themselves listed.
class ListedMatrix {
 public:
  ListedMatrix() = default;
  /// \param rows, columns  of this process
  /// \param i, j           per number of the list: its row, one of this process's, and its column, among all processes'
  /// \throws PetscFailure, also when there are more entries than PETSc counts
  ListedMatrix(MPI_Comm communicator, PetscInt rows, PetscInt columns, std::vector<PetscInt> i,
               const std::vector<PetscInt>& j, PetscInt block_size = 1);

  operator Mat() const { return matrix_; }

  /// `work(add)` calls add(number) for the numbers in the order of the list, all of them, on entries that are zero before.
  /// All processes together.
  template <class Work>
  void fill(Work&& work) {
    petsc_check(MatZeroEntries(matrix_));
    {
      const MatrixArrays arrays(matrix_);
      const PetscInt* place = places_.data();
      work([&](double number) {
        const PetscInt at = *place++;
        (at >= 0 ? arrays.own()[at] : arrays.other()[-1 - at]) += number;
      });
    }
    petsc_check(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
    petsc_check(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
  }

 private:
  OwnedMat matrix_;
  std::vector<PetscInt> places_;  ///< in the array of own columns, or -1 - place in that of the others
};

}  // namespace fsi
