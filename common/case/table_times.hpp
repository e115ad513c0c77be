#pragma once

#include "case/case.hpp"
#include "case/case_entry.hpp"

namespace fsi {

/// Warns of times that look like another unit beside the other times of the case:
/// - a table that ends within about a thousandth of its period; without a period one of four rows or more that ends
///   within 1/500 of the run and, of fixed steps, within the first: seconds;
/// - fixed steps of 100 ms and more with fewer than five per period: microseconds.
void warn_of_table_times(const CaseEntry& whole_case, const Case& scene);

}  // namespace fsi
