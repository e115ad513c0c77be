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
  std::vector<std::string> left_out{};  ///< volumes of the file that the scene does not have, for remedies
  /// Of triangle meshes: what is there called a volume is a physical surface, and what is called a surface a curve.
  TriangleGeometry geometry = TriangleGeometry::axisymmetric;
};

/// Refuses meshes that a scene cannot be computed on. `file` is for the messages only.
/// Throws InputError for: a missing volume or surface group; a facet with more than two cells, or with both on one side
/// (folded mesh); nodes in the same place; quadratic cells whose Jacobian is not positive everywhere; surface facets
/// that are no facets of the volumes they belong to, or that lie between two cells; a surface `symmetry_x` (y, z) that
/// is not normal to x (y, z) everywhere; fluid in several pieces; wall pieces that nothing supports: no face in
/// a surface that holds the wall or a symmetry plane, nor an axis of symmetry; with fluid and wall: no shared facet, faces that meet
/// without sharing nodes, or a node of the interface's rim that is neither in a surface that clamps it, nor in a symmetry plane, nor
/// on the axis of an axisymmetric mesh, nor in a surface of `supports` where an opening begins.
template <int Dim, int Order>
void check_scene_mesh(const SimplexMesh<Dim, Order>& mesh, const SceneMeshNeeds& needs, const std::string& file);

/// The same checks, of which each says the first thing that it refuses. Empty for a mesh that check_scene_mesh() takes.
template <int Dim, int Order>
std::vector<MeshFault> scene_mesh_faults(const SimplexMesh<Dim, Order>& mesh, const SceneMeshNeeds& needs,
                                         const std::string& file);

}  // namespace fsi
