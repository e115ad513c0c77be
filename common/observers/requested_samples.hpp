#pragma once

#include "observers/observation_points.hpp"

namespace fsi {

/// The name in lines.csv of the centre line of a tube that does not follow the axis of its case.
inline constexpr const char* found_line = "centerline";

/// The samples that a case asks for, with their cells and weights, and the centre line of a tube that does not follow
/// its axis. Samples outside the mesh are left out, with a warning for each point, line or plane.
/// \param points  of observation_points(); gets the warnings and notes
/// \throws InputError for a centre line between surfaces that do not bound the fluid, for a centre line or plane in a
/// case without fluid, and for a plane whose normal is normal to a plane mesh
template <class Element>
RequestedSamples requested_samples(const Case& setup, const MeshOf<Element>& mesh, const VesselParts<Element>& parts,
                                   ObservationPoints& points);

}  // namespace fsi
