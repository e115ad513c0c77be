#include "linear/distributed/matrix_arrays.hpp"

namespace fsi {

namespace {

bool is_of(Mat matrix, const char* type) {
  PetscBool is = PETSC_FALSE;
  petsc_check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(matrix), type, &is));
  return is == PETSC_TRUE;
}

}  // namespace

MatrixArrays::MatrixArrays(Mat matrix) : blocks_(is_of(matrix, MATSEQBAIJ) || is_of(matrix, MATMPIBAIJ)) {
  if (is_of(matrix, blocks_ ? MATSEQBAIJ : MATSEQAIJ))
    parts_[0] = matrix;
  else
    petsc_check((blocks_ ? MatMPIBAIJGetSeqBAIJ : MatMPIAIJGetSeqAIJ)(matrix, &parts_[0], &parts_[1], nullptr));
  for (int part = 0; part < 2; ++part)
    if (parts_[part] != nullptr)
      petsc_check((blocks_ ? MatSeqBAIJGetArray : MatSeqAIJGetArray)(parts_[part], &arrays_[part]));
}

MatrixArrays::~MatrixArrays() {
  for (int part = 0; part < 2; ++part)
    if (parts_[part] != nullptr)
      (blocks_ ? MatSeqBAIJRestoreArray : MatSeqAIJRestoreArray)(parts_[part], &arrays_[part]);
}

}  // namespace fsi
