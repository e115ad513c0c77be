#pragma once

#include <memory>

#include "case/case.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// Builds the sub-problems that the case has on a checked mesh (check_scene_mesh): boundary conditions of
/// docs/theory.md, section 2.4, the interface found from the cells.
/// \param mesh  as read, regions and surface groups by name
std::unique_ptr<Scene<P1Tetrahedron>> build_scene(const Case& setup, const TetrahedralMesh& mesh);

}  // namespace fsi
