#pragma once

#include <memory>

#include "case/case.hpp"
#include "mesh/mesh_share.hpp"
#include "scene/scene.hpp"
#include "scene/scene_parts.hpp"

namespace fsi {

/// Builds the sub-problems that the case has, discretised by an element, of their parts (find_parts): boundary conditions of
/// docs/theory.md, section 2.4, the interface found from the cells. Where the parts are restricted to what a process holds,
/// the scene is its share. To be called by all processes.
/// \throws InputError where the case and its mesh do not go together
template <class Element>
std::unique_ptr<Scene<Element::components>> build_scene(const Case& setup, SceneParts<Element>&& parts);

/// The same on a checked mesh (check_scene_mesh).
/// \param mesh   as read, regions and surface groups by name; the whole of it at each process
/// \param share  how its nodes are shared out: the scene has this process's share; null: the scene is whole. Must live
///               as long as what is left in `whole`
/// \param whole  receives the whole parts of a mesh that is shared out; null if and only if `share` is
template <class Element>
std::unique_ptr<Scene<Element::components>> build_scene(const Case& setup,
                                                        const SimplexMesh<Element::dim, Element::order>& mesh,
                                                        const MeshShare* share = nullptr,
                                                        WholeParts<Element>* whole = nullptr);

}  // namespace fsi
