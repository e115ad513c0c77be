#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "mesh/mesh_checks.hpp"

namespace fsi {

/// Checks that the case says of each named surface of the fluid whether it is open or closed: it must be an opening, a
/// plane of symmetry, shared with the wall, called `wall` or `inner`, or listed in `fluid.closed`. Without this check a
/// forgotten opening would be a rigid wall.
/// \param mesh  checked already \param needs  what the scene asks of it \param name  of the mesh, for messages
/// \return lines for the log: openings free of traction, and surfaces that are closed
/// \throws InputError with places and areas of surfaces that the case does not mention, and for a name in `fluid.closed`
/// that is no surface of the fluid
template <int Dim, int Order>
std::vector<std::string> open_and_closed_surfaces(const Case& setup, const SimplexMesh<Dim, Order>& mesh,
                                                  const SceneMeshNeeds& needs, const std::string& name);

}  // namespace fsi
