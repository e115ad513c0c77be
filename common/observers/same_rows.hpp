#pragma once

#include <vector>

#include "io/earlier_tables.hpp"
#include "io/result_tables.hpp"

namespace fsi {

/// Refuses a table of an earlier run whose last rows the checkpoint's state does not give again: columns of one measure are
/// compared by the largest number in any of them.
/// \param time  of the level, ms
/// \param seen  its rows now
/// \throws InputError naming the table
void require_same_rows(const EarlierTables& earlier, const ResultTable& table, double time,
                       const std::vector<TableRow>& seen);

}  // namespace fsi
