#pragma once

#include <map>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "scene/boundary_conditions.hpp"
#include "wall/wall_problem.hpp"

namespace fsi {

/// The facets of surfaces by name, in the numbers of the wall's part.
template <class Element>
using SupportFacets = std::map<std::string, FacetsOf<Element>>;
/// Those that supports hold or load. \param part  the wall
template <class Element>
SupportFacets<Element> support_facets(const Case& setup, const MeshOf<Element>& mesh, const PartOf<Element>& part);

/// Gives the wall the springs, dampers and loads of its supports; nothing when the case has none.
template <class Element>
void support_wall(const Case& setup, const SupportFacets<Element>& facets, WallProblem<Element>& wall);

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
