#pragma once

#include <vector>

#include "fem/elements.hpp"
#include "mesh/wall_faces.hpp"
#include "scene/scene.hpp"
#include "scene/scene_parts.hpp"

namespace fsi {

/// Thickness of a scene's wall at rest at each of its nodes here, mm: nodal_thickness() of the mesh. Empty where the
/// wall has no inner and outer face.
/// \param whole  whole parts of a mesh that processes share; empty: the scene has them
template <class Element>
std::vector<double> nodal_wall_thickness(const MeshOf<Element>& mesh, const Scene<Element::components>& scene,
                                         const WholeParts<Element>& whole) {
  std::vector<double> thickness;
  const auto of_mesh = nodal_thickness(mesh);
  if (of_mesh.empty()) return thickness;
  for (const int node : (whole.wall ? whole.wall->mesh_node : scene.wall->nodes().mesh_node))
    thickness.push_back(of_mesh[static_cast<std::size_t>(node)]);
  return whole.wall ? whole.wall_here->field(thickness) : thickness;
}

}  // namespace fsi
