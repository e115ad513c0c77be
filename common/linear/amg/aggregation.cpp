#include "linear/amg/aggregation.hpp"

#include <cmath>

namespace fsi {

std::vector<double> diagonal_of(const CsrMatrix<double>& a) {
  std::vector<double> diagonal(a.rows(), 0.0);
  for (int row = 0; row < a.rows(); ++row)
    for (int at = a.offsets[row]; at < a.offsets[row + 1]; ++at)
      if (a.indices[at] == row) diagonal[row] = a.values[at];
  return diagonal;
}

std::vector<char> strong_entries(const CsrMatrix<double>& a, const std::vector<double>& diagonal, double threshold) {
  std::vector<char> strong(a.nonzeros());
#pragma omp parallel for schedule(static) if (a.nonzeros() > 50000)
  for (int row = 0; row < a.rows(); ++row)
    for (int at = a.offsets[row]; at < a.offsets[row + 1]; ++at) {
      const int column = a.indices[at];
      strong[at] =
          column == row || std::abs(a.values[at]) > threshold * std::sqrt(std::abs(diagonal[row] * diagonal[column]));
    }
  return strong;
}

std::vector<int> aggregates(const CsrMatrix<double>& a, const std::vector<char>& strong, int& count) {
  std::vector<int> of(a.rows(), -1);
  count = 0;
  const auto neighbours = [&](int row, auto visit) {
    for (int at = a.offsets[row]; at < a.offsets[row + 1]; ++at)
      if (strong[at]) visit(a.indices[at]);
  };
  for (int row = 0; row < a.rows(); ++row) {
    bool untouched = of[row] < 0;
    neighbours(row, [&](int j) { untouched = untouched && of[j] < 0; });
    if (!untouched) continue;
    of[row] = count;
    neighbours(row, [&](int j) { of[j] = count; });
    ++count;
  }
  std::vector<int> joined = of;
  for (int row = 0; row < a.rows(); ++row)
    if (of[row] < 0) neighbours(row, [&](int j) { joined[row] = joined[row] < 0 ? of[j] : joined[row]; });
  for (int row = 0; row < a.rows(); ++row) {
    if (joined[row] >= 0) continue;
    joined[row] = count;
    neighbours(row, [&](int j) { joined[j] = joined[j] < 0 ? count : joined[j]; });
    ++count;
  }
  return joined;
}

}  // namespace fsi
