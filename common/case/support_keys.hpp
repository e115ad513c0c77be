#pragma once

#include "case/case_keys.hpp"
#include "case/support_loads.hpp"

namespace fsi {

/// The key `support`: a section for each surface that something holds or loads from outside.
CaseKey<Case> support_section();

/// The section [prestress].
CaseKey<Case> prestress_section();

/// Refuses supports, and a prestress, that the rest of the case has no use for. \throws InputError
void check_supports(const CaseEntry& whole_case, const Case& scene);

}  // namespace fsi
