#pragma once

#include <optional>

#include "case/case.hpp"

namespace fsi {

class CaseEntry;

/// What the mean pressure behind the openings comes to once compliances are full, kPa: in the steady state
/// p = (Q + sum p_d/R) / sum 1/R. Empty where flows and laws of the case do not determine it.
std::optional<double> mean_pressure_of_flow(const Case& scene);

/// Warns of outflow laws that look like values in mmHg s/ml and ml/mmHg, the usual units of the clinic:
/// - by the pressure that the mean flow into the fluid would raise behind all of them: in the steady state p is
///   (Q + sum p_d/R) / sum 1/R. It is 7.5 times too high when resistances are in mmHg s/ml;
/// - by the time constant, distal resistance times compliance, beside the period of the openings, or else the end of the
///   run. It is a number in seconds, a thousandth of that in ms, when both are in units of the clinic.
void warn_of_windkessel_units(const CaseEntry& whole_case, const Case& scene);

}  // namespace fsi
