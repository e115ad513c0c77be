#pragma once

#include <map>
#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"
#include "mesher/edge_curves.hpp"
#include "mesher/offset_normals.hpp"

namespace fsi {

/// A layer that a wall is to get.
struct GrownLayer {
  std::string name;      ///< of its volume group
  double thickness = 0;  ///< mm; with WallGrowth::total its share of that
  int elements = 1;      ///< through it
};

/// How a wall is grown on a lumen.
struct WallGrowth {
  std::vector<GrownLayer> layers;  ///< from the lumen outwards
  /// The fluid's surface that the wall grows on; empty: all of the fluid's boundary in no named surface but `inner`.
  std::string on;
  /// Thickness of the whole wall at each node that it grows on, mm; empty: the layers have their own everywhere.
  std::map<int, double> total;
  int smoothing = 2;  ///< times that the normals are averaged with their neighbours'
};

/// The facets that a wall grows on, seen from outside the lumen counter-clockwise: those of WallGrowth::on.
/// \throws InputError where there are none
std::vector<TetrahedralMesh::Facet> facets_to_grow_on(const TetrahedralMesh& lumen, const std::string& on);

/// Rims and normals of those facets, averaged with their neighbours' so many times.
/// \throws InputError for a rim that is not flat
OffsetNormals normals_to_grow_along(const TetrahedralMesh& lumen, const std::vector<TetrahedralMesh::Facet>& facets,
                                    int smoothing);

/// The thickness of a wall over what was asked for. Nodes include mid-edge nodes.
struct ReachedThickness {
  double least = 1, most = 1;   ///< distances of the outer surface's nodes from the surface that the wall grew on
  Point least_at{}, most_at{};  ///< mm
  double least_asked = 0;       ///< mm, at least_at
  std::size_t nodes = 0;        ///< of the outer surface
  std::size_t missed = 0;       ///< those that are off by more than thickness_tolerance
  double least_between = 1;     ///< distances of the nodes that the wall grew on from the outer surface
  Point least_between_at{};     ///< mm
};
inline constexpr double thickness_tolerance = 0.05;
inline constexpr double between_tolerance = 0.8;  ///< of least_between, below which there is a warning

/// Sentences on where the thickness is not what was asked for: at nodes, and between them where the surface bends round
/// sharper than its facets.
std::vector<std::string> warnings_of(const ReachedThickness& reached);

/// A lumen with its wall, and the thickness that was reached.
struct GrownWall {
  TetrahedralMesh mesh;
  ReachedThickness reached;
};

/// Grows a wall on the lumen's surface. Each layer ends at its distance from the surface. Its nodes lie along smoothed
/// vertex normals (offset_normals()); on rims these lie in the plane of the opening or of symmetry there, so that the
/// wall ends in it. Where the columns would fold, as in creases, their nodes slide along the offset surface
/// (mesher/column_tops.hpp). Columns are filled by fill_with_prisms().
///
/// The result has the lumen's cells and groups (but `on`), a volume per layer, and the surfaces `outer` and
/// `wall_ends`. What lies in a plane of symmetry is added to its group.
/// \param lumen  with a volume `fluid`
/// \throws InputError naming the fsi-mesh option at fault: no surface left to grow on, a name twice, an opening whose
///         rim is not flat, and a wall that folds or has less than a quarter of its thickness between nodes,
///         with the place
GrownWall grow_wall(const TetrahedralMesh& lumen, const WallGrowth& growth);

/// The same with quadratic cells.
struct QuadraticWall {
  SimplexMesh<3, 2> mesh;
  ReachedThickness reached;
  std::vector<Point>
      straightened;  ///< mm, middles of the lumen's edges over which the wall's are straight: curved, they fold cells
};

/// The same with quadratic cells on a lumen whose edges are curved. Distances are those from the curved surface.
/// Columns on the middles of its edges lie between those on the ends, with nodes at the layers' distances, too; the
/// diagonal of a column's side has its node half way between the middles of the edges below and above; edges through
/// layers are straight.
/// \param curves  of the lumen's edges, in its numbers
/// \param bendable  whether the lumen's curved edges may be made straight where cells fold; else those of the wall
///         alone
QuadraticWall grow_quadratic_wall(const TetrahedralMesh& lumen, EdgeCurves curves, bool bendable,
                                  const WallGrowth& growth);

}  // namespace fsi
