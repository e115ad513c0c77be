#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "mesh/mesh_checks.hpp"

namespace fsi {

/// Where fluid passes freely and where it does not, as far as the mesh names its surfaces. A name is there because
/// something happens there: each must be an opening, a plane of symmetry, shared with the wall, called `wall` or `inner`,
/// or listed in `fluid.closed`. A surface that is forgotten would else be a rigid lid.
/// \param mesh  checked already \param needs  what the scene asks of it \param name  of the mesh, for messages
/// \return lines for the log: openings free of traction, and surfaces that are closed
/// \throws InputError with places and areas of surfaces that the case does not mention, and for a name in `fluid.closed`
/// that is no surface of the fluid
template <int Dim, int Order>
std::vector<std::string> open_and_closed_surfaces(const Case& setup, const SimplexMesh<Dim, Order>& mesh,
                                                  const SceneMeshNeeds& needs, const std::string& name);

}  // namespace fsi
