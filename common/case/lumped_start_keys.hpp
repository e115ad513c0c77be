#pragma once

#include "case/case.hpp"
#include "case/case_entry.hpp"

namespace fsi {

/// With time.start = "lumped", gives the Windkessels the pressures of the periodic state of the laws behind the
/// openings alone (openings/lumped_start.hpp), with a remark each. \throws InputError where the case does not determine
/// them
void set_lumped_start(const CaseEntry& whole_case, Case& scene);

}  // namespace fsi
