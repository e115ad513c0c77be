#pragma once

#include <vector>

#include "case/openings.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "mesh/submesh.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// The facets of a group; none when the mesh has no group of that name.
const std::vector<TetrahedralMesh::Facet>& group_facets(const TetrahedralMesh& mesh, const std::string& name);

/// Facets of the whole mesh in the node numbers of a part.
std::vector<TetrahedralMesh::Facet> in_part(const Submesh<3>& part, const std::vector<TetrahedralMesh::Facet>& facets);

/// Where pressure acts on a wall without fluid: its interface with the fluid volume if the mesh has one, else the group
/// `inner`; normals out of the wall, nodes of the whole mesh.
std::vector<TetrahedralMesh::Facet> inner_surface(const TetrahedralMesh& mesh, const std::vector<int>& wall_regions);

/// The wall's displacement is zero on the clamped ends.
DirichletConditions<3> wall_conditions(const TetrahedralMesh& mesh, const Submesh<3>& wall);

/// What bounds the fluid.
struct FluidBoundary {
  DirichletConditions<3> velocity, mesh;
  std::vector<InterfaceNode> interface;
  std::vector<OpenBoundary<P1Tetrahedron>> open;
};

/// No slip on every facet that is neither open nor interface, and on the rims where the wall's clamped ends meet the
/// fluid; a mesh at rest there and on the open boundaries.
/// \param interface   facets between fluid and wall, nodes of the whole mesh
/// \param wall        the wall's part and its conditions; null pointers without wall
FluidBoundary fluid_boundary(const std::vector<OpeningData>& openings, const TetrahedralMesh& mesh,
                             const Submesh<3>& fluid, const std::vector<TetrahedralMesh::Facet>& interface,
                             const Submesh<3>* wall, const DirichletConditions<3>* wall_conditions);

}  // namespace fsi
