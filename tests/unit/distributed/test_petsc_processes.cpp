// What PETSc computes on several processes. Run by 3 of them: two others' contributions may come in either order.
#include <gtest/gtest.h>

#include <algorithm>

#include "linear/distributed/petsc_call.hpp"

namespace fsi::test {

namespace {

/// A matrix with one row a process.
OwnedMat one_row_each(MPI_Comm communicator, PetscInt columns, PetscInt column, double value) {
  OwnedMat matrix;
  petsc_check(
      MatCreateAIJ(communicator, 1, columns, PETSC_DETERMINE, PETSC_DETERMINE, 1, nullptr, 1, nullptr, matrix.fresh()));
  PetscInt row = 0;
  petsc_check(MatGetOwnershipRange(matrix, &row, nullptr));
  petsc_check(MatSetValue(matrix, row, column, value, INSERT_VALUES));
  petsc_check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  petsc_check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
  return matrix;
}

/// P' A P with A = diag(1e16, 1, -1e16, ...) and P a column of ones: 0 or 1, whichever process is heard first.
TEST(PetscProcesses, GalerkinProductsAddInOneOrder) {
  const Communicator& processes = Communicator::world();
  const MPI_Comm communicator = petsc_communicator(processes);
  const double numbers[] = {1e16, 1, -1e16};
  const OwnedMat a = one_row_each(communicator, 1, processes.rank(), numbers[processes.rank() % 3]);
  const OwnedMat p = one_row_each(communicator, processes.is_first() ? 1 : 0, 0, 1);
  double smallest = 2, largest = -1;
  for (int i = 0; i < 200; ++i) {
    OwnedMat product;
    petsc_check(MatPtAP(a, p, MAT_INITIAL_MATRIX, 2, product.fresh()));
    double sum = 0;
    petsc_check(MatNorm(product, NORM_FROBENIUS, &sum));
    smallest = std::min(smallest, sum);
    largest = std::max(largest, sum);
  }
  EXPECT_EQ(smallest, largest);
}

}  // namespace

}  // namespace fsi::test
