#pragma once

#include "mesher/surface/lumen_openings.hpp"

namespace fsi {

/// Cuts an opening of the surface back by a plane square to the vessel's centre line, `distance` mm behind the
/// opening's centre. The centre line's direction there is that between the centres of the sections half a radius, or
/// half the distance if that is less, before and behind; it is found by fixed-point iteration from the opening's
/// normal. What lies beyond the plane and is connected with the opening goes.
/// \throws InputError naming `--cut`: the plane does not meet the vessel in one closed line between the opening and the
///         rest of the surface, or cuts another opening
void cut_square(TriangleSurface& surface, LumenOpening& opening, double distance);

/// Moves the nodes of an opening's rim into its plane.
/// \throws InputError naming `--opening`: the rim is farther off its plane than half an edge and a tenth of its
///         diameter
void flatten_rim(TriangleSurface& surface, LumenOpening& opening);

}  // namespace fsi
