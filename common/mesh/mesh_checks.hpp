#pragma once

#include <string>
#include <vector>

#include "mesh/mesh_fault.hpp"
#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// What a scene asks of its mesh.
struct SceneMeshNeeds {
  bool fluid = false;                   ///< a volume `fluid`
  std::vector<std::string> layers;      ///< names of the wall's volumes; empty: no wall
  bool inlet = false;                   ///< a surface `inlet` on the fluid
  bool outlet = false;                  ///< a surface `outlet` on the fluid
  std::vector<std::string> openings{};  ///< further surfaces on the fluid, that it passes through
  bool inner_surface = false;           ///< a surface `inner` on the wall (a wall without fluid)
  std::vector<std::string> supports;    ///< surfaces on the outside of the wall that something holds or loads
  std::vector<std::string> holding = {"wall_ends"};   ///< of all surfaces, those that hold the wall
  std::vector<std::string> clamping = {"wall_ends"};  ///< those where it cannot move at all
  bool at_rest = false;                               ///< whether the wall is sought at rest, without inertia
  std::vector<std::string> left_out{};  ///< volumes of the file that the scene does not have, for remedies
  /// Of triangle meshes, whose volumes are physical surfaces and whose surfaces are physical curves.
  TriangleGeometry geometry = TriangleGeometry::axisymmetric;
};

/// Refuses meshes that a scene cannot be computed on. `file` is for the messages only. Throws InputError for: a missing
/// volume or surface group; nodes in the same place; quadratic cells whose Jacobian is not positive everywhere; a facet
/// with more than two cells, or with both on one side (folded mesh); surface facets that are no facets of the volumes
/// they belong to, that lie between two cells, or that are in two openings or in an opening and a symmetry plane; a
/// surface `symmetry_x` (y, z) that is not normal to x (y, z) everywhere, another symmetry plane that is not flat; an
/// axis whose quadratic sides are not straight; fluid in several pieces; pieces of a wall, unless it is axisymmetric
/// and not sought at rest, without a face in a symmetry plane or a surface that holds the wall; with fluid and wall: no
/// shared facet, faces that meet without sharing nodes, or a node of the interface's rim that is neither in a surface
/// that clamps it, nor in a symmetry plane, nor on the axis of an axisymmetric mesh, nor in a surface of `supports`
/// where an opening begins.
template <int Dim, int Order>
void check_scene_mesh(const SimplexMesh<Dim, Order>& mesh, const SceneMeshNeeds& needs, const std::string& file);

/// What each of these checks refuses first; those that need sound facets are skipped without them. Empty for a mesh
/// that check_scene_mesh() takes.
template <int Dim, int Order>
std::vector<MeshFault> scene_mesh_faults(const SimplexMesh<Dim, Order>& mesh, const SceneMeshNeeds& needs,
                                         const std::string& file);

}  // namespace fsi
