#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi::test {

/// A point of a quadrature rule on one cell.
struct CellPoint {
  Point x;                               ///< mm
  double weight;                         ///< mm^3
  std::array<double, 4> shape;           ///< N_a
  const std::array<Point, 4>* gradient;  ///< grad N_a of the cell, 1/mm
};

/// Visits the 27 points of the conical Gauss rule on every tetrahedron, exact for polynomials of degree 3 and with an
/// error of sixth order: negligible beside that of linear elements, and independent of the elements' own rule and
/// gradients.
template <class Cells, class Visit>
void integrate_cells(const std::vector<Point>& nodes, const Cells& cells, Visit visit) {
  static const double s[3] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)}, w[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto& cell = cells[c];
    double e[3][3], inverse[3][3];
    for (int a = 0; a < 3; ++a)
      for (int i = 0; i < 3; ++i) e[a][i] = nodes[cell[a + 1]][i] - nodes[cell[0]][i];
    double det = 0;
    for (int a = 0; a < 3; ++a)
      for (int i = 0; i < 3; ++i) {
        const int a1 = (a + 1) % 3, a2 = (a + 2) % 3, i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        inverse[a][i] = e[a1][i1] * e[a2][i2] - e[a1][i2] * e[a2][i1];
        if (a == 0) det += e[0][i] * inverse[0][i];
      }
    std::array<Point, 4> gradient{};
    for (int a = 0; a < 3; ++a)
      for (int i = 0; i < 3; ++i) {
        gradient[a + 1][i] = inverse[a][i] / det;
        gradient[0][i] -= inverse[a][i] / det;
      }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) {
          // Cube to tetrahedron: xi = s_i, eta = (1 - xi) s_j, zeta = (1 - xi - eta) s_k = (1 - xi)(1 - s_j) s_k.
          const double xi = s[i], eta = (1 - xi) * s[j], zeta = (1 - xi) * (1 - s[j]) * s[k];
          CellPoint p;
          p.shape = {1 - xi - eta - zeta, xi, eta, zeta};
          p.weight = det * w[i] * w[j] * w[k] * (1 - xi) * (1 - xi) * (1 - s[j]);
          p.x = {};
          for (int a = 0; a < 4; ++a)
            for (int d = 0; d < 3; ++d) p.x[d] += p.shape[a] * nodes[cell[a]][d];
          p.gradient = &gradient;
          visit(c, p);
        }
  }
}

/// Value and gradient, (i, j) = d u_i / d x_j, of a linear vector field with `entries` numbers per node.
struct VectorAt {
  Point value{};
  std::array<Point, 3> gradient{};
};
template <class Cell>
VectorAt vector_at(const std::vector<double>& field, int entries, const Cell& cell, const CellPoint& p) {
  VectorAt u;
  for (int a = 0; a < 4; ++a)
    for (int i = 0; i < 3; ++i) {
      const double nodal = field[static_cast<std::size_t>(cell[a]) * entries + i];
      u.value[i] += p.shape[a] * nodal;
      for (int j = 0; j < 3; ++j) u.gradient[i][j] += (*p.gradient)[a][j] * nodal;
    }
  return u;
}
template <class Cell>
double scalar_at(const std::vector<double>& field, int entries, int entry, const Cell& cell, const CellPoint& p) {
  double value = 0;
  for (int a = 0; a < 4; ++a) value += p.shape[a] * field[static_cast<std::size_t>(cell[a]) * entries + entry];
  return value;
}

/// Errors of one mesh, and what a sequence of meshes makes of them.
class ConvergenceTable {
 public:
  explicit ConvergenceTable(std::string title, std::vector<std::string> columns)
      : title_(std::move(title)), columns_(std::move(columns)) {}

  void add(double h, const std::vector<double>& errors) { rows_.push_back({h, errors}); }

  /// Order observed between the last two rows.
  double last_order(int column) const { return order(rows_.size() - 1, column); }
  double last_error(int column) const { return rows_.back().second[column]; }
  /// Of Richardson's extrapolation of the last two rows for first order and errors of one sign, h halved.
  double extrapolated_error(int column) const {
    return std::abs(2 * rows_.back().second[column] - rows_[rows_.size() - 2].second[column]);
  }

  void print() const {
    fmt::print("{}\n  {:>10}", title_, "h");
    for (const auto& name : columns_) fmt::print("  {:>22}  order", name);
    fmt::print("\n");
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      fmt::print("  {:10.4g}", rows_[r].first);
      for (int c = 0; c < static_cast<int>(columns_.size()); ++c) {
        fmt::print("  {:22.4e}  ", rows_[r].second[c]);
        r > 0 ? fmt::print("{:5.2f}", order(r, c)) : fmt::print("     ");
      }
      fmt::print("\n");
    }
  }

 private:
  double order(std::size_t row, int column) const {
    return std::log(rows_[row - 1].second[column] / rows_[row].second[column]) /
           std::log(rows_[row - 1].first / rows_[row].first);
  }

  std::string title_;
  std::vector<std::string> columns_;
  std::vector<std::pair<double, std::vector<double>>> rows_;
};

}  // namespace fsi::test
