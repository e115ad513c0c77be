#pragma once

#include <string>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Names the faces of a wall without fluid by their shape: facet groups `inner`, `outer` and `wall_ends` are added.
/// Ends are plane parts of the boundary between creases of 30 degrees, with two rims each, as rings have. What is left
/// must be two faces: the inner one, whose normals look inwards, and the outer one. Facets in planes of symmetry are no
/// part of any face; rings that such planes cut open are not found.
/// \return what was found, a sentence with its newline
/// \throws InputError for a mesh with a volume `fluid`, for one of these names that is there, and for another kind of
///         boundary, which it describes
template <int Order>
std::string name_wall_faces(SimplexMesh<3, Order>& mesh, const std::string& file);

}  // namespace fsi
