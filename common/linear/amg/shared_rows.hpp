#pragma once

#include <vector>

#include "parallel/exchange.hpp"

namespace fsi {

/// Rows of a sparse matrix whose entries have `width` numbers each; columns ascend in a row.
struct SparseRows {
  int width = 1;
  std::vector<int> offsets{0}, columns;
  std::vector<double> values;

  int rows() const { return static_cast<int>(offsets.size()) - 1; }
};

// All of these but renumber() by all processes together. Copies of columns stand in the order of their numbers.

/// Own rows, then those of copies, as their owners have them.
/// \param rows     own ones
/// \param fine     of the rows
/// \param columns  theirs; gets copies of all that are named by rows of copies
SparseRows with_rows_of_copies(SparseRows rows, const ShareOfNumbers& fine, ShareOfNumbers& columns);

/// Own rows with what other processes' rows of copies add to them.
/// \param rows   own ones, then those of copies
/// \param share  of rows and columns; gets copies of all that are named by what is added
SparseRows sum_of_rows(const SparseRows& rows, ShareOfNumbers& share);

/// All rows of all processes, at each of them, by numbers among all processes' ones.
/// \param rows   own ones
/// \param share  of rows and columns
SparseRows gather_rows(const SparseRows& rows, const ShareOfNumbers& share);

/// Columns by another share, which has copies of all of them.
void renumber(std::vector<int>& columns, const ShareOfNumbers& from, const ShareOfNumbers& to);

}  // namespace fsi
