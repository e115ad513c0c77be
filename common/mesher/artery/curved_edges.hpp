#pragma once

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// A tube about the z axis with a node in the middle of every edge, curved as the tube is. The nodes of the linear mesh
/// keep their numbers; an edge between two nodes of one radius, from `inner_radius` outwards, has its middle at that
/// radius. In the wall the middle is at the mean radius, angle and height of the two ends, the map from cylindrical
/// coordinates evaluated there; towards the axis it moves to the middle of the straight edge by the square of the
/// radius over `inner_radius`, so that edges become straight where rings have few of them. Middles of edges in planes
/// through the axis stay in them, in x = 0 and y = 0 exactly.
///
/// Throws InputError naming --order where that folds a cell: determinant of its Jacobian not positive everywhere.
SimplexMesh<3, 2> with_curved_edges(const TetrahedralMesh& tube, double inner_radius);

}  // namespace fsi
