#pragma once

#include <optional>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// How finely a mesh of tetrahedra divides the lumen.
struct CellsAcross {
  double width;  ///< mm; 4 V / A of the fluid's volume and the surface around it: the diameter of a tube
  double edge;   ///< mm; mean length of the edges of the fluid's cells, between vertices
  double cells() const { return width / edge; }
};

/// Of the volume `fluid`; A is its boundary without the facets of named surfaces, but with its interface and surfaces
/// that are no openings by name (mesh/group_names.hpp). Empty if the volume or A is missing.
template <int Order>
std::optional<CellsAcross> cells_across(const SimplexMesh<3, Order>& mesh);

}  // namespace fsi
