#pragma once

#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"
#include "mesh_io/gmsh_file.hpp"

namespace fsi {

template <int Order>
using TriangleCell = typename SimplexMesh<2, Order>::Cell;

/// Brings the triangles of a file into the plane of their geometry, (r, 0, z) or (x, y, 0); what is zero to rounding
/// becomes zero.
/// \param cells  by places of nodes in the file
/// \throws InputError for a node out of the plane, or with a negative radius
template <int Order>
void lay_into_plane(const std::string& file, GmshFile& gmsh, const std::vector<TriangleCell<Order>>& cells,
                    TriangleGeometry geometry);

/// Turns clockwise cells round, with their mid-edge nodes.
template <int Order>
void turn_counter_clockwise(const std::vector<Point>& nodes, std::vector<TriangleCell<Order>>& cells);

}  // namespace fsi
