#pragma once

#include "algebra/block_matrix.hpp"
#include "fem/nodal_frames.hpp"
#include "fem/unknowns.hpp"

namespace fsi {

/// Adds a sub-problem's block matrix to a system matrix under the numbering of its rows and columns.
/// \param builder  has add(row, column, number, factor), as GatheredMatrix::Builder has
template <class Builder, int Rows, int Columns>
void gather_blocks(Builder& builder, const BlockMatrix<Rows, Columns>& matrix, const UnknownMap& rows,
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

/// The same for a matrix with one number per component of space in each block, as the mesh motion has.
/// \param frames  in which rows and columns are counted; null: along the axes of space
template <class Builder, int Components>
void gather_diagonal_blocks(Builder& builder, const BlockMatrix<1, Components>& matrix, const UnknownMap& rows,
                            const UnknownMap& columns, const NodalFrames<Components>* frames = nullptr) {
  const auto& graph = *matrix.graph;
  for (int a = 0; a < graph.rows(); ++a)
    for (int at = graph.offsets[a]; at < graph.offsets[a + 1]; ++at) {
      const int b = graph.columns[at];
      if (frames && (frames->at(a) || frames->at(b))) {
        for (int i = 0; i < Components; ++i)
          for (int j = 0; j < Components; ++j) {
            const Unknown& row = rows[static_cast<std::size_t>(a) * Components + i];
            const Unknown& column = columns[static_cast<std::size_t>(b) * Components + j];
            if (row.index < 0 || column.index < 0) continue;
            for (int k = 0; k < Components; ++k)
              if (const double share = frames->share(k, a, b, i, j); share != 0)
                builder.add(row.index, column.index, matrix.block(at) + k, row.factor * column.factor * share);
          }
        continue;
      }
      for (int k = 0; k < Components; ++k) {
        const Unknown& row = rows[static_cast<std::size_t>(a) * Components + k];
        const Unknown& column = columns[static_cast<std::size_t>(b) * Components + k];
        if (row.index >= 0 && column.index >= 0)
          builder.add(row.index, column.index, matrix.block(at) + k, row.factor * column.factor);
      }
    }
}

}  // namespace fsi
