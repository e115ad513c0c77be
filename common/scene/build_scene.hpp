#pragma once

#include <memory>

#include "case/case.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// Builds the sub-problems that the case has, discretised by an element, on a checked mesh (check_scene_mesh): boundary
/// conditions of docs/theory.md, section 2.4, the interface found from the cells.
/// \param mesh  as read, regions and surface groups by name
template <class Element>
std::unique_ptr<Scene<Element::components>> build_scene(const Case& setup,
                                                        const SimplexMesh<Element::dim, Element::order>& mesh);

}  // namespace fsi
