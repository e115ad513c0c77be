#pragma once

#include <vector>

#include "algebra/csr_matrix.hpp"

namespace fsi {

/// Products for the largest eigenvalue that a smoother or a prolongation is scaled by: a few percent will do.
inline constexpr int eigenvalue_iterations = 12;

/// Which entries couple strongly, |a_ij| > threshold sqrt(|a_ii a_jj|); the diagonal always does.
/// \param diagonal  per column of a, copies' too
/// \returns per entry of a
std::vector<char> strong_entries(const CsrMatrix<double>& a, const std::vector<double>& diagonal, double threshold);

/// The aggregate of each row [Vanek1996]: first whole neighbourhoods of strong couplings, then
/// leftovers join a neighbour's, then form their own.
/// \param strong  per entry of a; false for columns behind the rows
/// \param count   set to the number of aggregates
std::vector<int> aggregates(const CsrMatrix<double>& a, const std::vector<char>& strong, int& count);

/// A's diagonal.
std::vector<double> diagonal_of(const CsrMatrix<double>& a);

}  // namespace fsi
