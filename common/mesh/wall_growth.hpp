#pragma once

#include <map>
#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// A layer that a wall is to get.
struct GrownLayer {
  std::string name;      ///< of its volume group
  double thickness = 0;  ///< mm; with WallGrowth::total its share of that
  int elements = 1;      ///< through it
};

struct WallGrowth {
  std::vector<GrownLayer> layers;  ///< from the lumen outwards
  /// The fluid's surface that the wall grows on; empty: what no named surface but `inner` holds.
  std::string on;
  /// Thickness of the whole wall at each node that it grows on, mm; empty: the layers have their own everywhere.
  std::map<int, double> total;
  int smoothing = 2;  ///< times that the normals are averaged with their neighbours'
};

/// The facets that a wall grows on, seen from outside the lumen counter-clockwise: those of WallGrowth::on.
/// \throws InputError where there are none
std::vector<TetrahedralMesh::Facet> facets_to_grow_on(const TetrahedralMesh& lumen, const std::string& on);

/// Grows a wall on the lumen's surface. Each layer follows the surface at its distance along smoothed vertex normals,
/// [Max1999]'s, which are those of a sphere or a cylinder up to rounding; on the rims they lie in the plane of the
/// opening there, so that the wall ends in it. Columns of prisms between surface and offset are each cut into three
/// tetrahedra by the order of their nodes, so that neighbours fit.
///
/// The result has the lumen's cells and groups (but `on`), a volume per layer, and the surfaces `outer` and `wall_ends`.
/// \param lumen  with a volume `fluid`
/// \throws InputError naming the fsi-mesh option at fault: no surface left to grow on, a name twice, an opening whose rim
///         is not flat, and a wall that folds, with the place and the thickness there is room for
TetrahedralMesh grow_wall(const TetrahedralMesh& lumen, const WallGrowth& growth);

}  // namespace fsi
