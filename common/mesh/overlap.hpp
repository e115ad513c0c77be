#pragma once

#include <cstddef>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Cells of one volume that reach into cells of another one, or of the same one.
struct Overlap {
  int of, within;         ///< regions
  std::size_t cells = 0;  ///< of `of` that reach into a cell of `within`
  Point first{};          ///< where one of them does, mm
};

/// Where cells lie in each other: a place in a cell near one of its vertices, a tenth of the way to its middle, lies in another cell,
/// too, where every barycentric coordinate is 0.001 at least. Places are looked for in cells near them only
/// (mesh/cell_grid.hpp). Cells that cross without such a place in each other are not seen, cells without volume not looked at.
template <int Dim, int Order>
std::vector<Overlap> overlaps(const SimplexMesh<Dim, Order>& mesh);

}  // namespace fsi
