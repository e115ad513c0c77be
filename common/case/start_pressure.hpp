#pragma once

#include "case/case.hpp"
#include "case/case_entry.hpp"

namespace fsi {

/// Warns of laws of openings, and of tables that repeat themselves, that begin with a pressure which an elastic wall does
/// not carry then: a vessel at rest begins with that of [prestress], or none. It is filled from behind, by a flow
/// backwards of the difference over the proximal resistance at most, or emptied. What matters is measured by the wall's
/// shear modulus: a tube whose wall has a tenth of its radius widens by three times the difference over that.
void warn_of_start_pressure(const CaseEntry& whole_case, const Case& scene);

}  // namespace fsi
