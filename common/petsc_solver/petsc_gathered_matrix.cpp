#include "petsc_solver/petsc_gathered_matrix.hpp"

#include <utility>

namespace fsi {

PetscGatheredMatrix::PetscGatheredMatrix(MPI_Comm communicator, PetscInt rows, Builder&& builder)
    : numbers_(std::move(builder.numbers_)), factors_(std::move(builder.factors_)), values_(factors_.size()) {
  petsc_check(MatCreate(communicator, matrix_.fresh()));
  petsc_check(MatSetSizes(matrix_, rows, rows, PETSC_DECIDE, PETSC_DECIDE));
  petsc_check(MatSetType(matrix_, MATAIJ));
  petsc_check(MatSetPreallocationCOO(matrix_, static_cast<PetscCount>(builder.rows_.size()), builder.rows_.data(),
                                     builder.columns_.data()));
}

void PetscGatheredMatrix::update() {
  for (std::size_t i = 0; i < values_.size(); ++i) values_[i] = factors_[i] * *numbers_[i];
  petsc_check(MatSetValuesCOO(matrix_, values_.data(), INSERT_VALUES));
}

}  // namespace fsi
