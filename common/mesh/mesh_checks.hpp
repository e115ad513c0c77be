#pragma once

#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// What a scene asks of its mesh.
struct SceneMeshNeeds {
  bool fluid = false;               ///< a volume `fluid`
  std::vector<std::string> layers;  ///< names of the wall's volumes; empty: no wall
  bool inlet_outlet = false;        ///< surfaces `inlet` and `outlet` on the fluid
  bool inner_surface = false;       ///< a surface `inner` on the wall (a wall without fluid)
};

/// Refuses meshes that a scene cannot be computed on. `file` is for the messages only.
/// Throws InputError for: a missing volume or surface group; a facet with more than two cells, or with both on one side
/// (folded mesh); nodes in the same place; surface triangles that are no facets of the volumes they belong to; fluid in
/// several pieces, wall pieces that are clamped nowhere; with fluid and wall: no shared facet, faces that meet without
/// sharing nodes, or a rim of the interface that is not in `wall_ends`.
void check_scene_mesh(const TetrahedralMesh& mesh, const SceneMeshNeeds& needs, const std::string& file);

}  // namespace fsi
