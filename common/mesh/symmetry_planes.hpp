#pragma once

#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"
#include "mesh/submesh.hpp"

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

/// A plane of symmetry and the nodes in it.
struct MirrorPlane {
  Point normal;             ///< unit vector
  double offset;            ///< mm: normal . x of its points
  std::vector<char> holds;  ///< per node of a mesh or a part
};

template <int Dim, int Order>
std::vector<MirrorPlane> mirror_planes(const SimplexMesh<Dim, Order>& mesh);
/// The same in the numbers of a part of the mesh.
std::vector<MirrorPlane> of_part(std::vector<MirrorPlane> planes, const PartNodes& part);

/// The point nearest to x that lies in all of these planes; of planes without a common point in as many as have one.
Point projected(Point x, const std::vector<const MirrorPlane*>& planes);

}  // namespace fsi
