#pragma once

#include <optional>

#include "case/case.hpp"

namespace fsi {

class CaseEntry;

/// The mean pressure behind the openings in the steady state, kPa: p = (Q + sum p_d/R) / sum 1/R, Q being the mean flow
/// into the fluid, R and p_d resistance and distal pressure of each law. Empty if flows and laws do not determine it.
std::optional<double> mean_pressure_of_flow(const Case& scene);

/// Warns of outflow laws that look like values in mmHg s/ml and ml/mmHg, the usual clinical units:
/// - by mean_pressure_of_flow(), which is 7.5 times too high when resistances are in mmHg s/ml;
/// - by the time constant, distal resistance times compliance, beside the period of the openings, or else the end of
///   the run. In clinical units it is a number of seconds, a thousandth of that in ms.
void warn_of_windkessel_units(const CaseEntry& whole_case, const Case& scene);

}  // namespace fsi
