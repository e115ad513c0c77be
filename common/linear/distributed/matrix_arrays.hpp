#pragma once

#include "linear/distributed/petsc_call.hpp"

namespace fsi {

/// The numbers that a matrix of PETSc holds, AIJ or BAIJ: of its part with own columns, and of the other, which there is
/// not on one process. Row by row with ascending columns; of BAIJ block by block, and those column by column. In PETSc's
/// hands again when this ends.
class MatrixArrays {
 public:
  explicit MatrixArrays(Mat matrix);
  ~MatrixArrays();
  MatrixArrays(const MatrixArrays&) = delete;
  MatrixArrays& operator=(const MatrixArrays&) = delete;

  double* own() const { return arrays_[0]; }
  double* other() const { return arrays_[1]; }

 private:
  bool blocks_;
  Mat parts_[2] = {nullptr, nullptr};
  double* arrays_[2] = {nullptr, nullptr};
};

}  // namespace fsi
