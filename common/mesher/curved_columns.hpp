#pragma once

#include <vector>

#include "mesh/simplex_mesh.hpp"
#include "mesher/edge_curves.hpp"
#include "mesher/prism_columns.hpp"

namespace fsi {

/// Adds the curves of columns of prisms that end on a surface with curved edges. Below the middle of an edge of the
/// surface a column stands in the mean direction of those below its ends, with nodes at the mean of their distances
/// from the surface: on cylinders and spheres those of concentric ones. The diagonal of a column's side has its node
/// half way between the middles of the edges below and above; edges along columns are straight.
/// \param surface  the curved edges of the surface, which are kept
EdgeCurves with_columns(const TetrahedralMesh& mesh, const Levels& levels, const EdgeCurves& surface);

/// straighten_folded() for whole columns: takes away curves of the surface's edges, and with each those below, until no
/// cell is folded.
/// \return the middles of the surface's edges that are straight now, mm
std::vector<Point> straighten_folded_columns(const TetrahedralMesh& mesh, const Levels& levels, EdgeCurves& surface);

}  // namespace fsi
