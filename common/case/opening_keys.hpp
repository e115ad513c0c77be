#pragma once

#include "case/case_keys.hpp"

namespace fsi {

/// [[opening]], read as a section for each surface.
CaseKey<Case> opening_key();

/// Checks openings against the rest of the case. \throws InputError
void check_openings(const CaseEntry& whole_case, const Case& scene);
/// Refuses surfaces that are both closed and open. \throws InputError
void check_closed(const CaseEntry& whole_case, const Case& scene);

}  // namespace fsi
