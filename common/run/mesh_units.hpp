#pragma once

#include <optional>
#include <string>

#include "case/case.hpp"

namespace fsi {

/// How large what a mesh holds is, in the mesh's units, taken for mm.
struct VesselSize {
  double opening = 0;  ///< of the widest opening: diameter of the circle of its area; 0: there is none
  double extent = 0;   ///< of the mesh along the axis of space along which it is longest
};

/// What makes a mesh look as if it were not in mm: openings of a vessel that, in mm, no vessel has, in a flow whose
/// viscosity spreads across them a thousand times sooner, or a million times later, than the run is long. Both must hold,
/// so that no test channel of another fluid is blamed. A wall under prestress is a vessel's, whatever flows in it and for
/// how long: there the size alone tells, without fluid that of the mesh.
/// \returns a line with the remedy; empty where nothing is strange
std::optional<std::string> unit_slip_of_mesh(const Case& setup, const VesselSize& size);

}  // namespace fsi
