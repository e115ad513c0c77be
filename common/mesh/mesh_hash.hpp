#pragma once

#include <string>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Hash of a mesh (FNV-1a 64, 16 hexadecimal digits): nodes to the last bit, cells, each cell's volume by its name, and
/// the facets of each surface by its name. Empty surfaces, and the order of groups and facets, do not count.
template <int Dim, int Order>
std::string hash_of_mesh(const SimplexMesh<Dim, Order>& mesh);

}  // namespace fsi
