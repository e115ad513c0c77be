#pragma once

#include <vector>

#include "mesher/surface/triangle_surface.hpp"

namespace fsi {

/// Local radius of a lumen at each node p of its surface, mm: that of the largest ball inside that touches the surface
/// there, the least |p - q|^2 / (2 (p - q) n) of nodes q within 60 degrees of the inward normal -n at p [Ma2012], some
/// 20,000 of them at most. Outside of this cone roughness would make the balls small. Where no node lies in it, the
/// largest of all radii; infinite if that holds everywhere, as on a plane. On a round tube it is the radius.
/// \param passes  the field is averaged with its neighbours' so many times
std::vector<double> local_radius(const TriangleSurface& surface, int passes);

/// Smooths a field of the nodes: each pass takes it half of the way to the mean of the neighbours' (neighbours_of()).
void average_with_neighbours(const TriangleSurface& surface, std::vector<double>& field, int passes);

}  // namespace fsi
