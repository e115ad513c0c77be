#pragma once

#include "mesh/simplex_mesh.hpp"
#include "mesher/artery/options.hpp"

namespace fsi {

/// A conforming mesh with volumes `fluid`, `media`, `adventitia` (unless its thickness is 0) and surfaces `inlet`
/// (z = 0), `outlet`, `wall_ends`, `outer`. Every node of an interface or of the outer face lies on its cylinder.
///
/// The cross-section (a hexagonal pattern of triangles bent into the disk, then rings of triangles) is extruded into
/// prisms, turned half a step from station to station and back, and each prism cut into three tetrahedra. Sizes are met
/// as nearly as whole numbers allow, see artery_cells(). Throws InputError for what artery_cells() throws for, or when
/// all that gives a tetrahedron of mean ratio below 1e-3.
TetrahedralMesh generate_artery(const ArteryOptions& options);

/// A mesh of the same volumes and surfaces by numbers of cells, which may be graded, of the whole tube or of a sector
/// between planes of symmetry (see ring_section()), whose surfaces are `symmetry_y`, and `symmetry_x` or `symmetry_1`:
/// nodes on the first two have y = 0 or x = 0 exactly. Stations stand in line; diagonals alternate around and along, so
/// that the mesh is as stiff one way around as the other. Throws InputError with the fsi-mesh option at fault.
TetrahedralMesh generate_artery(const ArteryShape& shape, const ArteryCells& cells, int sector_degrees = 360);

/// The meridian section of the artery for axisymmetric scenes: triangles with nodes (r, 0, z), counter-clockwise seen
/// with r to the right and z upwards; regions `fluid`, `media`, `adventitia`; curves `inlet`, `outlet`, `wall_ends`,
/// `outer`, the mesh to their left. Diagonals alternate. `cells.around` has no effect. Throws InputError with the
/// fsi-mesh option at fault.
TriangleMesh generate_artery_section(const ArteryShape& shape, const ArteryCells& cells);

}  // namespace fsi
