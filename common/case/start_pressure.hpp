#pragma once

#include "case/case.hpp"
#include "case/case_entry.hpp"

namespace fsi {

/// Warns of opening laws and periodic pressure tables that begin with another pressure than an elastic wall carries at
/// rest, that of [prestress] or none. The vessel is then filled from behind, by a backward flow of at most the
/// difference over the proximal resistance, or emptied. The difference is compared with the wall's shear modulus: a
/// tube whose thickness is a tenth of its radius widens by three times their ratio.
void warn_of_start_pressure(const CaseEntry& whole_case, const Case& scene);

}  // namespace fsi
