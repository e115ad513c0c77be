#pragma once

#include <vector>

#include "parallel/exchange.hpp"

namespace fsi {

/// Rows of a sparse matrix whose entries have `width` numbers each.
struct SparseRows {
  int width = 1;
  std::vector<int> offsets{0}, columns;
  std::vector<double> values;

  int rows() const { return static_cast<int>(offsets.size()) - 1; }
};

/// Behind an interpolation's own rows those of copies, as their owners have them. By all processes together.
/// \param rows    own ones, whose columns are own coarse unknowns, ascending
/// \param fine    of the rows
/// \param coarse  own ones
/// \param share   gets that of the coarse unknowns: these, and behind them copies of others that the rows name
SparseRows with_rows_of_copies(SparseRows rows, const ShareOfNumbers& fine, int coarse, ShareOfNumbers& share);

/// All rows of all processes, at each of them, by numbers among all processes' ones. By all processes together.
/// \param rows   own ones
/// \param share  of rows and columns
SparseRows gather_rows(const SparseRows& rows, const ShareOfNumbers& share);

}  // namespace fsi
