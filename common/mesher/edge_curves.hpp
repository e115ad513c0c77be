#pragma once

#include <map>
#include <utility>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Mid-edge nodes, mm, by the edges' ends, the smaller number first. Edges that are not there are straight, their nodes
/// half way.
using EdgeCurves = std::map<std::pair<int, int>, Point>;

/// All mid-edge nodes of a quadratic mesh, in the numbers of without_mid_edge_nodes().
EdgeCurves curves_of(const SimplexMesh<3, 2>& mesh);

/// with_mid_edge_nodes(), the edges curved.
SimplexMesh<3, 2> with_curves(const TetrahedralMesh& mesh, const EdgeCurves& curves);

/// Cells whose det J is not positive everywhere, ascending.
std::vector<int> folded_cells(const SimplexMesh<3, 2>& mesh);

/// Takes the curves of folded cells' edges away until no cell is folded.
/// \param mesh  whose straight cells are not
/// \return the middles of the edges that are straight now, mm
std::vector<Point> straighten_folded(const TetrahedralMesh& mesh, EdgeCurves& curves);

/// Volume of a region's cells, mm^3.
double volume_of(const SimplexMesh<3, 2>& mesh, int region);

}  // namespace fsi
