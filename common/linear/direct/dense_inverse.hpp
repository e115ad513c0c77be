#pragma once

#include <vector>

namespace fsi {

/// The inverse of a dense matrix of `rows` rows and columns, by LU with partial pivoting; empty when an entry of it is
/// not finite. A matrix that is nearly singular may still give a finite inverse.
/// \param matrix  rows * rows entries, row by row or column by column; the inverse has the same order
std::vector<double> dense_inverse(const std::vector<double>& matrix, int rows);

}  // namespace fsi
