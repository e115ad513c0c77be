#pragma once

#include "case/case.hpp"
#include "case/case_entry.hpp"
#include "case/case_keys.hpp"

namespace fsi {

/// The key `periods` of [time], "until 1%": a run ends when it has become periodic.
CaseKey<TimeData> periods_key();

/// Sets the period of a run that ends so. \throws InputError without a fluid, without a period, and if fewer than three
/// fit before the end; for a period that nothing uses
void check_periodic_end(const CaseEntry& whole_case, Case& scene);

}  // namespace fsi
