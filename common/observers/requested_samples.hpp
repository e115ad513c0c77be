#pragma once

#include "observers/observation_points.hpp"

namespace fsi {

/// The name of the line in lines.csv that a tube gets whose centre line is not along its axis.
inline constexpr const char* found_line = "centerline";

/// The samples that a case asks for, with their cells and weights, and the centre line of a tube that does not follow its
/// axis. What lies outside the mesh is left out, with a warning for each point, line or plane.
/// \param points  what is sampled anyway; gets the warnings and notes
/// \throws InputError for a centre line between surfaces that the fluid does not have, a line or plane of the fluid in a
/// case without
template <class Element>
RequestedSamples requested_samples(const Case& setup, const MeshOf<Element>& mesh, const VesselParts<Element>& parts,
                                   ObservationPoints& points);

}  // namespace fsi
