#include "linear/distributed/listed_matrix.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace fsi {

ListedMatrix::ListedMatrix(MPI_Comm communicator, PetscInt rows, PetscInt columns, std::vector<PetscInt> i,
                           const std::vector<PetscInt>& j, PetscInt block_size) {
  if (i.size() > static_cast<std::size_t>(std::numeric_limits<PetscInt>::max()))
    throw PetscFailure("a matrix has more entries on one process than PETSc counts as it is installed");
  petsc_check(MatCreate(communicator, matrix_.fresh()));
  petsc_check(MatSetSizes(matrix_, rows, columns, PETSC_DECIDE, PETSC_DECIDE));
  petsc_check(MatSetBlockSize(matrix_, block_size));
  petsc_check(MatSetType(matrix_, MATAIJ));
  PetscLayout of_rows = nullptr, of_columns = nullptr;
  petsc_check(MatGetLayouts(matrix_, &of_rows, &of_columns));
  petsc_check(PetscLayoutSetUp(of_rows));
  petsc_check(PetscLayoutSetUp(of_columns));
  PetscInt first_row = 0, first_column = 0, end_column = 0;
  petsc_check(PetscLayoutGetRange(of_rows, &first_row, nullptr));
  petsc_check(PetscLayoutGetRange(of_columns, &first_column, &end_column));

  std::vector<PetscInt> begin(static_cast<std::size_t>(rows) + 1, 0);  // of a row's numbers in `order`
  for (const PetscInt row : i) ++begin[row - first_row + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<PetscInt> order(i.size()), next(begin.begin(), begin.end() - 1);
  for (std::size_t k = 0; k < i.size(); ++k) order[next[i[k] - first_row]++] = static_cast<PetscInt>(k);

  places_ = std::move(i);  // no longer wanted: memory peaks here
  std::vector<PetscInt> offsets{0}, entries;
  PetscInt own = 0, other = 0;
  for (PetscInt row = 0; row < rows; ++row) {
    const auto from = order.begin() + begin[row], to = order.begin() + begin[row + 1];
    std::sort(from, to, [&](PetscInt a, PetscInt b) { return j[a] < j[b]; });
    for (auto k = from; k != to; ++k) {
      const PetscInt column = j[*k];
      const bool is_own = column >= first_column && column < end_column;
      if (k == from || column != j[*(k - 1)]) {
        entries.push_back(column);
        ++(is_own ? own : other);
      }
      places_[*k] = is_own ? own - 1 : -other;
    }
    offsets.push_back(static_cast<PetscInt>(entries.size()));
  }
  petsc_check(MatSeqAIJSetPreallocationCSR(matrix_, offsets.data(), entries.data(), nullptr));
  petsc_check(MatMPIAIJSetPreallocationCSR(matrix_, offsets.data(), entries.data(), nullptr));
}

}  // namespace fsi
