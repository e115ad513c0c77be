#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "algebra/block_matrix.hpp"

namespace fsi::test {

inline double norm(const std::vector<double>& x) {
  double sum = 0;
  for (double value : x) sum += value * value;
  return std::sqrt(sum);
}
inline double largest(const std::vector<double>& x) {
  double found = 0;
  for (double value : x) found = std::isfinite(value) ? std::max(found, std::abs(value)) : INFINITY;
  return found;
}
inline std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> c(a);
  for (std::size_t i = 0; i < c.size(); ++i) c[i] -= b[i];
  return c;
}
/// x + t y
inline std::vector<double> moved(const std::vector<double>& x, double t, const std::vector<double>& y) {
  std::vector<double> z(x);
  for (std::size_t i = 0; i < z.size(); ++i) z[i] += t * y[i];
  return z;
}

/// Entries first ... first + count - 1 of every node of an array with `entries` numbers per node; the others zero.
inline std::vector<double> only(const std::vector<double>& all, int entries, int first, int count) {
  std::vector<double> part(all.size(), 0.0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int k = static_cast<int>(i % entries);
    if (k >= first && k < first + count) part[i] = all[i];
  }
  return part;
}

/// A x for a matrix of blocks, nodal arrays on both sides.
template <int Rows, int Columns>
std::vector<double> multiply(const BlockMatrix<Rows, Columns>& a, const std::vector<double>& x) {
  const auto& graph = *a.graph;
  std::vector<double> y(static_cast<std::size_t>(graph.rows()) * Rows, 0.0);
  for (int row = 0; row < graph.rows(); ++row)
    for (int at = graph.offsets[row]; at < graph.offsets[row + 1]; ++at)
      for (int r = 0; r < Rows; ++r)
        for (int c = 0; c < Columns; ++c)
          y[static_cast<std::size_t>(row) * Rows + r] +=
              a.block(at)[r * Columns + c] * x[static_cast<std::size_t>(graph.columns[at]) * Columns + c];
  return y;
}

}  // namespace fsi::test
