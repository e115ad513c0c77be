#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"

namespace fsi {

/// The surfaces of a case's openings, of those that its mesh has. \param surfaces  of the mesh, by name
/// \param mesh  its name, for messages
/// \throws InputError for an opening that the case demands and the mesh does not have, with the nearest name, and for a
/// fluid between rigid walls that is closed or whose flow is given at every opening: its pressure is not determined
std::vector<std::string> required_openings(const Case& setup, const std::vector<std::string>& surfaces,
                                           const std::string& mesh);

}  // namespace fsi
