#pragma once

#include <vector>

namespace fsi {

/// The inverse of a dense matrix of `rows` rows and columns; empty when it is singular to working precision.
/// \param matrix  entries in any order of rows and columns; the inverse comes in the same
std::vector<double> dense_inverse(const std::vector<double>& matrix, int rows);

}  // namespace fsi
