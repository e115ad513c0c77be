#pragma once

#include <cstdint>
#include <vector>

#include "linear/distributed/listed_matrix.hpp"

namespace fsi {

/// A matrix of PETSc whose entries are sums of weighted numbers that stand in other arrays, at places worked out once.
class PetscGatheredMatrix {
 public:
  /// Collects the terms; all arrays must keep their size and place for the life of the matrix.
  class Builder {
   public:
    /// \param row, column  among all processes' ones; the row is this process's
    void add(std::int64_t row, std::int64_t column, const double* number, double factor) {
      rows_.push_back(static_cast<PetscInt>(row));
      columns_.push_back(static_cast<PetscInt>(column));
      numbers_.push_back(number);
      factors_.push_back(factor);
    }

   private:
    friend class PetscGatheredMatrix;
    std::vector<PetscInt> rows_, columns_;
    std::vector<const double*> numbers_;
    std::vector<double> factors_;
  };

  PetscGatheredMatrix() = default;
  /// \param rows  of this process; columns are shared out alike
  PetscGatheredMatrix(MPI_Comm communicator, PetscInt rows, Builder&& builder);

  void update();
  Mat matrix() const { return matrix_; }

 private:
  ListedMatrix matrix_;
  std::vector<const double*> numbers_;
  std::vector<double> factors_;
};

}  // namespace fsi
