#pragma once

#include "case/case.hpp"
#include "case/case_entry.hpp"

namespace fsi {

/// Warns of times that look like another unit beside the other times of the case:
/// - a table that ends a thousandth of its period in, or lies within the first step though it has a course: seconds;
/// - fixed steps of 100 ms and more of which a period has fewer than five: microseconds.
void warn_of_table_times(const CaseEntry& whole_case, const Case& scene);

}  // namespace fsi
