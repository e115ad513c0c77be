#pragma once

#include "mesher/surface/lumen_openings.hpp"

namespace fsi {

/// Makes a vessel longer at an opening: its rim, flat, is drawn out along the plane's normal by `diameters` times the
/// opening's diameter, in rings as far apart as the rim's nodes. Over the first diameter the rings become a circle of
/// the rim's area, smoothly (3 s^2 - 2 s^3), over the whole length where the extension is shorter. The last ring
/// becomes the opening's rim.
void extend(TriangleSurface& surface, LumenOpening& opening, double diameters);

}  // namespace fsi
