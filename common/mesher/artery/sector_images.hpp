#pragma once

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// The whole tube about the z axis that a sector and its mirror images make up: the sector from 0 to `degrees`, its
/// image in its second plane, that one's image in the next, and so on round. Nodes on the planes and on the axis are
/// shared, and the groups of the two planes are left out. The sector's own nodes and cells come first.
/// \param degrees  a divisor of 180, at most 90: the circle holds an even number of sectors, at least four
/// \param first    group of the faces at angle 0
/// \param second   group of those at `degrees`
TetrahedralMesh joined_with_sector_images(const TetrahedralMesh& sector, int degrees, const char* first,
                                          const char* second);

}  // namespace fsi
