#pragma once

#include "mesher/surface/triangle_surface.hpp"

namespace fsi {

/// Smooths a surface, nodes on rims along them: each pass moves all nodes towards the mean of their neighbours by
/// lambda = 0.5 of the way, then away from it by mu of the way [Taubin1995]. Waves shorter than a few edges die, longer
/// ones stay. Which waves neither grow nor die depends on mu, 0.5 to 0.6: it is found so that the volume stays, to 1e-4
/// where that is possible.
void taubin_smooth(TriangleSurface& surface, int passes);

}  // namespace fsi
