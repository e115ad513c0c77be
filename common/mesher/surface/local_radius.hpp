#pragma once

#include <vector>

#include "mesher/surface/triangle_surface.hpp"

namespace fsi {

/// Local radius of a lumen at each node of its surface, mm: of the largest ball inside that touches the surface there,
/// min |p - q|^2 / (2 (p - q) n) over all nodes q that lie within 60 degrees of the inward normal -n at p [Ma2012]. It is the
/// radius of a round tube. Nodes closer to the normal's cone than that would let roughness make the balls small.
/// \param passes  the field is averaged with its neighbours' so many times
std::vector<double> local_radius(const TriangleSurface& surface, int passes);

/// Smooths a field of the nodes: each pass takes it half of the way to the mean of the neighbours', on rims of those on the rim.
void average_with_neighbours(const TriangleSurface& surface, std::vector<double>& field, int passes);

}  // namespace fsi
