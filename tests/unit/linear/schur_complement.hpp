#pragma once

#include <Eigen/Dense>
#include <vector>

#include "algebra/block_matrix.hpp"

namespace fsi::test {

/// C + B A^-1 B^T of [A B^T; B -C], dense.
template <int Size>
Eigen::MatrixXd schur_complement(const BlockMatrix<Size, Size>& matrix) {
  constexpr int n = Size - 1;
  const int nodes = matrix.graph->rows();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n * nodes, n * nodes), g = Eigen::MatrixXd::Zero(n * nodes, nodes),
                  d = Eigen::MatrixXd::Zero(nodes, n * nodes), e = Eigen::MatrixXd::Zero(nodes, nodes);
  for (int i = 0; i < nodes; ++i)
    for (int at = matrix.graph->offsets[i]; at < matrix.graph->offsets[i + 1]; ++at) {
      const int j = matrix.graph->columns[at];
      const double* block = matrix.block(at);
      for (int r = 0; r < n; ++r) {
        for (int c = 0; c < n; ++c) a(n * i + r, n * j + c) = block[r * Size + c];
        g(n * i + r, j) = block[r * Size + n];
        d(i, n * j + r) = block[n * Size + r];
      }
      e(i, j) = block[Size * Size - 1];
    }
  return d * a.partialPivLu().solve(g) - e;
}

/// Smallest eigenvalue of the symmetric part of S q = lambda M q with a diagonal M.
inline double smallest_eigenvalue(const Eigen::MatrixXd& s, const std::vector<double>& mass) {
  Eigen::VectorXd root(s.rows());
  for (Eigen::Index i = 0; i < s.rows(); ++i) root[i] = 1 / std::sqrt(mass[i]);
  const Eigen::MatrixXd scaled = root.asDiagonal() * ((s + s.transpose()) / 2) * root.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

}  // namespace fsi::test
