#pragma once

#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// A plane of symmetry of a mesh.
template <int Dim, int Order>
struct SymmetryPlane {
  const typename SimplexMesh<Dim, Order>::FacetGroup* group;
  /// Unit vector of either sign. Of `symmetry_x`, `symmetry_y` and `symmetry_z` the axis; else the mean normal of the
  /// facets, with components below 1e-10 set to zero.
  Point normal;
};
template <int Dim, int Order>
using SymmetryPlanes = std::vector<SymmetryPlane<Dim, Order>>;

/// The planes of symmetry of a mesh: groups with such a name (group::is_symmetry_plane) and facets, in their order.
/// They point into the mesh. check_scene_mesh() checks that each is flat.
template <int Dim, int Order>
SymmetryPlanes<Dim, Order> symmetry_planes(const SimplexMesh<Dim, Order>& mesh);

}  // namespace fsi
