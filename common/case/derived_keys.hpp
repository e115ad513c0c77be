#pragma once

#include <vector>

#include "case/case_entry.hpp"
#include "case/case_keys.hpp"
#include "case/derived_output.hpp"

namespace fsi {

/// Keys of [output] for surfaces, forces, statistics and error indicator.
std::vector<CaseKey<OutputData>> derived_output_keys();

/// Refuses what the scene cannot have: a field of a medium that is not there, statistics without a period. Sets the
/// statistics' period if the case leaves it out. \throws InputError
void check_derived_output(const CaseEntry& whole_case, Case& scene);

}  // namespace fsi
