#pragma once

#include <string>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// What a mesh is to a scene, as a hash (FNV-1a 64, 16 hexadecimal digits): nodes to the last bit, cells, the volume that
/// each cell belongs to by its name, and the facets of each surface with a meaning of its own (mesh/group_names.hpp) by
/// the surface's name. Surfaces of other names, which scenes ignore, and the order of the groups do not count.
template <int Dim, int Order>
std::string hash_of_mesh(const SimplexMesh<Dim, Order>& mesh);

}  // namespace fsi
