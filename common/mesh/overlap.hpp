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

/// Cells that reach into each other: a point of a cell, a tenth of the way from a vertex to the centre, lies in another
/// cell, too, with barycentric coordinates of 0.001 or more. Cells that cross without such a point are not found; flat
/// and inverted ones are left out.
template <int Dim, int Order>
std::vector<Overlap> overlaps(const SimplexMesh<Dim, Order>& mesh);

}  // namespace fsi
