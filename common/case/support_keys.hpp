#pragma once

#include "case/case_keys.hpp"
#include "case/support_loads.hpp"

namespace fsi {

/// The key `support`: a section for each surface that is held or loaded from outside.
CaseKey<Case> support_section();

/// The section [prestress].
CaseKey<Case> prestress_section();

/// Checks supports and prestress against the rest of the case. \throws InputError
void check_supports(const CaseEntry& whole_case, const Case& scene);

}  // namespace fsi
