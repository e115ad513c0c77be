#pragma once

#include <vector>

#include "io/earlier_tables.hpp"
#include "io/result_tables.hpp"

namespace fsi {

/// Compares the last rows of an earlier run's table with those of the checkpoint's state: columns of one measure
/// relative to the largest number in any of them.
/// \param time  of the level, ms
/// \param seen  rows of the checkpoint's state, as many as the table's last level has
/// \throws InputError naming the table if they differ by more than 1e-6
void require_same_rows(const EarlierTables& earlier, const ResultTable& table, double time,
                       const std::vector<TableRow>& seen);

}  // namespace fsi
