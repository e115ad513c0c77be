#pragma once

#include <vector>

#include "case/case.hpp"
#include "mesh/mesh_share.hpp"
#include "scene/boundary_conditions.hpp"
#include "wall/wall_problem.hpp"

namespace fsi {

/// Gives the wall the springs, dampers and loads of its supports; nothing when the case has none.
/// \param part  the whole wall
/// \param here  what of it the problem has; null: all
template <class Element>
void support_wall(const Case& setup, const MeshOf<Element>& mesh, const PartOf<Element>& part,
                  const PartRestriction* here, WallProblem<Element>& wall);

/// The surfaces on which supports hold components of the wall's displacement.
/// \throws InputError where the normal of a curved surface is asked for
template <class Element>
std::vector<HeldSurface<Element::components>> surfaces_held_by_supports(const Case& setup, const MeshOf<Element>& mesh,
                                                                        const PartOf<Element>& wall);

/// Both sides of the interface count components along the same axes. \throws InputError where a support's fixed
/// components turn those of the wall alone
template <int n>
void require_common_frames(const Case& setup, const Scene<n>& scene);

}  // namespace fsi
