#pragma once

#include "case/case_keys.hpp"

namespace fsi {

/// [[opening]], read as a section for each surface.
CaseKey<Case> opening_key();

/// What openings need of the case as a whole. \throws InputError
void check_openings(const CaseEntry& whole_case, const Case& scene);
/// No surface is closed and open. \throws InputError
void check_closed(const CaseEntry& whole_case, const Case& scene);

}  // namespace fsi
