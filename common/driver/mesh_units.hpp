#pragma once

#include <optional>
#include <string>

#include "case/case.hpp"

namespace fsi {

/// What makes a mesh look as if it were not in mm: openings of a vessel that, in mm, no vessel has, in a flow whose
/// viscosity spreads across them a thousand times sooner, or a million times later, than the run is long. Both must hold,
/// so that no test channel of another fluid is blamed.
/// \param diameter  of the widest opening, mm: of the circle of its area
/// \returns a line with the remedy; empty where nothing is strange
std::optional<std::string> unit_slip_of_mesh(const Case& setup, double diameter);

}  // namespace fsi
