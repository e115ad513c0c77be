#pragma once

#include "case/case.hpp"
#include "case/case_entry.hpp"

namespace fsi {

/// Gives the Windkessels of a case with time.start = "lumped" the pressures of the periodic state of what lies behind the
/// openings alone (openings/lumped_start.hpp), and says which. \throws InputError where the case does not determine them
void set_lumped_start(const CaseEntry& whole_case, Case& scene);

}  // namespace fsi
