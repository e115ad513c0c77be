#include "linear/distributed/petsc_gathered_matrix.hpp"

#include <utility>

namespace fsi {

PetscGatheredMatrix::PetscGatheredMatrix(MPI_Comm communicator, PetscInt rows, Builder&& builder)
    : matrix_(communicator, rows, rows, std::move(builder.rows_), builder.columns_),
      numbers_(std::move(builder.numbers_)),
      factors_(std::move(builder.factors_)) {}

void PetscGatheredMatrix::update() {
  matrix_.fill([&](auto add) {
    for (std::size_t i = 0; i < factors_.size(); ++i) add(factors_[i] * *numbers_[i]);
  });
}

}  // namespace fsi
