#pragma once

#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// A point for messages, "(0, 0, 5) mm"; what is zero to rounding is shown as zero.
std::string place_of(Point x);

/// A flat part of a lumen's surface that is to have a name.
struct FlatPart {
  std::string name;
  Point at;  ///< mm; the flat part of the surface nearest to it is meant
};

/// Adds a facet group for each of `wanted`: parts of the fluid's boundary that are flat to 5 degrees, with sharp edges
/// (more than 30 degrees) around, as the cap of a segmented lumen is.
/// \throws InputError when there is no flat part, for two of one place, and for a name that a surface has
template <int Order>
void name_flat_parts(SimplexMesh<3, Order>& mesh, const std::vector<FlatPart>& wanted);

/// Where such parts are, for messages.
template <int Order>
std::string places_of_flat_parts(const SimplexMesh<3, Order>& mesh);

}  // namespace fsi
