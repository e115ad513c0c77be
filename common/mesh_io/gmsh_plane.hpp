#pragma once

#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"
#include "mesh_io/gmsh_file.hpp"

namespace fsi {

template <int Order>
using TriangleCell = typename SimplexMesh<2, Order>::Cell;

/// Moves the triangles of a file to where meshes of their geometry lie; what is zero to rounding becomes zero.
/// \param cells  by places of nodes in the file
/// \throws InputError for a node out of the plane, or with a negative radius
template <int Order>
void lay_into_plane(const std::string& file, GmshFile& gmsh, const std::vector<TriangleCell<Order>>& cells,
                    TriangleGeometry geometry);

template <int Order>
void turn_counter_clockwise(const std::vector<Point>& nodes, std::vector<TriangleCell<Order>>& cells);

}  // namespace fsi
