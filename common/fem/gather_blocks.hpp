#pragma once

#include "algebra/block_matrix.hpp"
#include "algebra/gathered_matrix.hpp"
#include "fem/unknowns.hpp"

namespace fsi {

/// Adds a sub-problem's block matrix to a system matrix under the numbering of its rows and columns.
template <int Rows, int Columns>
void gather_blocks(GatheredMatrix::Builder& builder, const BlockMatrix<Rows, Columns>& matrix, const UnknownMap& rows,
                   const UnknownMap& columns) {
  const auto& graph = *matrix.graph;
  for (int a = 0; a < graph.rows(); ++a)
    for (int at = graph.offsets[a]; at < graph.offsets[a + 1]; ++at) {
      const int b = graph.columns[at];
      for (int r = 0; r < Rows; ++r) {
        const Unknown& row = rows[static_cast<std::size_t>(a) * Rows + r];
        if (row.index < 0) continue;
        for (int c = 0; c < Columns; ++c) {
          const Unknown& column = columns[static_cast<std::size_t>(b) * Columns + c];
          if (column.index < 0) continue;
          builder.add(row.index, column.index, matrix.block(at) + r * Columns + c, row.factor * column.factor);
        }
      }
    }
}

/// The same for a matrix whose blocks hold one number per component, as the mesh motion's.
template <int Components>
void gather_diagonal_blocks(GatheredMatrix::Builder& builder, const BlockMatrix<1, Components>& matrix,
                            const UnknownMap& rows, const UnknownMap& columns) {
  const auto& graph = *matrix.graph;
  for (int a = 0; a < graph.rows(); ++a)
    for (int at = graph.offsets[a]; at < graph.offsets[a + 1]; ++at)
      for (int k = 0; k < Components; ++k) {
        const Unknown& row = rows[static_cast<std::size_t>(a) * Components + k];
        const Unknown& column = columns[static_cast<std::size_t>(graph.columns[at]) * Components + k];
        if (row.index >= 0 && column.index >= 0)
          builder.add(row.index, column.index, matrix.block(at) + k, row.factor * column.factor);
      }
}

}  // namespace fsi
