#pragma once

#include <string>
#include <vector>

#include "mesh/flat_parts.hpp"

namespace fsi {

/// Of options --opening NAME=X,Y,Z. \throws InputError
std::vector<FlatPart> flat_parts_of(const std::vector<std::string>& options);

}  // namespace fsi
