#pragma once

#include <vector>

#include "mesh/axis.hpp"
#include "scene/wall_boundary.hpp"

namespace fsi {

/// Whether a wall is a cylinder about an axis, hollow or solid, whole or a sector: of each of its connected pieces the
/// vertices that look to the axis have one distance from it, those that look away have another, and nothing lies outside
/// of the two. "One" allows for the flat facets of a mesh of 12 elements around that was refined: 4 %.
/// \param axis  of triangles in a plane its origin counts, of a body of revolution it is the body's own
template <class Element>
bool is_cylinder(const MeshOf<Element>& mesh, const WallFacets<Element>& boundary, Axis axis);

}  // namespace fsi
