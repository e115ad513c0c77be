#pragma once

#include "algebra/csr_matrix.hpp"

namespace fsi::test {

/// Seven-point Laplacian on an m x m x m grid, values given on the boundary, plus `mass` on the diagonal.
inline CsrMatrix<double> csr_laplacian(int m, double mass = 0) {
  CsrMatrix<double> a;
  a.columns = m * m * m;
  for (int i = 0; i < a.columns; ++i) {
    const int place[3] = {i / (m * m), i / m % m, i % m}, stride[3] = {m * m, m, 1};
    for (int k = 0; k < 3; ++k)
      if (place[k] > 0) {
        a.indices.push_back(i - stride[k]);
        a.values.push_back(-1);
      }
    a.indices.push_back(i);
    a.values.push_back(6 + mass);
    for (int k = 2; k >= 0; --k)
      if (place[k] < m - 1) {
        a.indices.push_back(i + stride[k]);
        a.values.push_back(-1);
      }
    a.offsets.push_back(static_cast<int>(a.indices.size()));
  }
  return a;
}

}  // namespace fsi::test
