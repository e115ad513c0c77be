#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "algebra/block_matrix.hpp"
#include "monolithic/coupled_solvers/amg/transfer.hpp"

namespace fsi {

/// The sparsity of L^T A R: coarse nodes couple when fine nodes they reach do.
NodeGraph galerkin_graph(const NodeGraph& fine, const NodeTransfer& left, const NodeTransfer& right);

/// Position of the block (column, row) for each block (row, column) of a symmetric graph.
std::vector<int> transposed_positions(const NodeGraph& graph);

/// Coarse matrices L^T A R of one level; for a square sub-problem L = R, for coupling blocks the transfers of the two
/// fields. Prescribed vector parts drop out on both sides. The pattern is made once, values as often as needed.
/// \tparam RowVector, ColumnVector  leading rows and columns of a block that belong to the vector part
template <int Rows, int Columns, int RowVector, int ColumnVector>
class GalerkinProduct {
 public:
  using Matrix = BlockMatrix<Rows, Columns>;

  GalerkinProduct() = default;
  /// \param fine  the fine graph, read by the constructor alone; the product shares the transfers
  GalerkinProduct(const NodeGraph& fine, std::shared_ptr<const NodeTransfer> left,
                  std::shared_ptr<const NodeTransfer> right)
      : left_(std::move(left)),
        right_(std::move(right)),
        coarse_graph_(std::make_shared<NodeGraph>(galerkin_graph(fine, *left_, *right_))) {}
  /// On a graph that holds galerkin_graph(), e.g. shared with another matrix.
  GalerkinProduct(std::shared_ptr<const NodeGraph> coarse, std::shared_ptr<const NodeTransfer> left,
                  std::shared_ptr<const NodeTransfer> right)
      : left_(std::move(left)), right_(std::move(right)), coarse_graph_(std::move(coarse)) {}

  Matrix make_coarse() const { return Matrix(coarse_graph_); }

  /// coarse = L^T fine R; `coarse` is of make_coarse(). No allocation after the first call.
  void compute(const Matrix& fine, Matrix& coarse) const {
    const NodeGraph& from = *fine.graph;
    const NodeGraph& to = *coarse_graph_;
    const NodeTransfer &left = *left_, &right = *right_;
#pragma omp parallel if (from.blocks() > 2000)
    {
      thread_local std::vector<int> place;  // position in the current coarse row, by coarse column
      if (static_cast<int>(place.size()) < right.coarse_nodes) place.resize(right.coarse_nodes);
#pragma omp for schedule(dynamic, 32)
      for (int row = 0; row < left.coarse_nodes; ++row) {
        for (int at = to.offsets[row]; at < to.offsets[row + 1]; ++at) {
          place[to.columns[at]] = at;
          std::fill_n(coarse.block(at), Matrix::block_size, 0.0);
        }
        for (int a = left.transposed.offsets[row]; a < left.transposed.offsets[row + 1]; ++a) {
          const int i = left.transposed.columns[a];
          const double row_weight = left.transposed_weights[a];
          const int first_row = left.fine_prescribed[i] ? RowVector : 0;
          for (int at = from.offsets[i]; at < from.offsets[i + 1]; ++at) {
            const int j = from.columns[at];
            const int first_column = right.fine_prescribed[j] ? ColumnVector : 0;
            const double* block = fine.block(at);
            for (int b = right.graph.offsets[j]; b < right.graph.offsets[j + 1]; ++b) {
              const double weight = row_weight * right.weights[b];
              double* sum = coarse.block(place[right.graph.columns[b]]);
              if (first_row == 0 && first_column == 0) {
                for (int k = 0; k < Matrix::block_size; ++k) sum[k] += weight * block[k];
              } else {
                for (int r = first_row; r < Rows; ++r)
                  for (int c = first_column; c < Columns; ++c) sum[r * Columns + c] += weight * block[r * Columns + c];
              }
            }
          }
        }
      }
    }
  }

 private:
  std::shared_ptr<const NodeTransfer> left_, right_;
  std::shared_ptr<const NodeGraph> coarse_graph_;
};

/// Galerkin products of a saddle-point matrix with blocks (vector, scalar) and of a component-wise scalar matrix.
template <int Size>
using SaddleGalerkin = GalerkinProduct<Size, Size, Size - 1, Size - 1>;
template <int Numbers>
using EllipticGalerkin = GalerkinProduct<1, Numbers, 1, Numbers>;

/// Puts `value` on the diagonal of prescribed vector parts, whose Galerkin rows and columns are empty.
template <int Size>
void set_prescribed_diagonal(BlockMatrix<Size, Size>& a, const std::vector<char>& prescribed, int vector,
                             double value = 1) {
  for (int row = 0; row < a.graph->rows(); ++row)
    if (prescribed[row]) {
      double* block = a.block(a.graph->find(row, row));
      for (int k = 0; k < vector; ++k) block[k * Size + k] = value;
    }
}
/// The same for a component-wise scalar matrix.
template <int Numbers>
void set_prescribed_numbers(BlockMatrix<1, Numbers>& a, const std::vector<char>& prescribed, double value = 1) {
  for (int row = 0; row < a.graph->rows(); ++row)
    if (prescribed[row]) std::fill_n(a.block(a.graph->find(row, row)), Numbers, value);
}

/// Multiplies the scalar-scalar entry (last row, last column) of every block: the stabilisation -C of [A B^T; B -C]. A
/// Galerkin coarse matrix has C ~ h^2 (grad p, grad q) of the finest mesh where its own mesh size H asks for H^2:
/// [Wabro2004] scales it up from level to level.
template <int Size>
void scale_scalar_entries(BlockMatrix<Size, Size>& a, double factor) {
  if (factor == 1) return;
  const int blocks = a.graph->blocks();
#pragma omp parallel for schedule(static) if (blocks > 20000)
  for (int at = 0; at < blocks; ++at) a.block(at)[Size * Size - 1] *= factor;
}

}  // namespace fsi
