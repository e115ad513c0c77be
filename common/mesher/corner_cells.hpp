#pragma once

#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Cells of the fluid in corners of its boundary, with which the Taylor-Hood element has no solution: all their edges
/// lie on the boundary, as do all edges of all cells around one of their vertices. Where the velocity is given there,
/// no free velocity is left beside the pressure of the vertex, which then has no equation [Boffi1997]. Openings count
/// as boundary, since a case may give the flow there; planes of symmetry and the axis of revolution do not, since the
/// fluid moves along them.
/// \return their numbers, ascending; empty without a volume `fluid`
template <int Dim, int Order>
std::vector<int> corner_cells(const SimplexMesh<Dim, Order>& mesh);

/// Divides cells at their centres, a tetrahedron in four, a triangle in three. Their sides do not change, so that the
/// mesh stays conforming; curved edges and faces stay where they are.
/// \param cells  numbers, ascending. The first part of each keeps its place; new cells and nodes follow the others.
template <int Dim, int Order>
SimplexMesh<Dim, Order> divided_at_centres(SimplexMesh<Dim, Order> mesh, const std::vector<int>& cells);

/// The centre of gravity of a cell's vertices, mm.
template <int Dim, int Order>
Point centre_of_vertices(const SimplexMesh<Dim, Order>& mesh, int cell) {
  Point centre{0, 0, 0};
  for (int a = 0; a <= Dim; ++a)
    for (int d = 0; d < 3; ++d) centre[d] += mesh.nodes[mesh.cells[cell][a]][d] / (Dim + 1);
  return centre;
}

}  // namespace fsi
