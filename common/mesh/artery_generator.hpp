#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Dimensions of a straight two-layer artery along the z axis from (0,0,0), and how finely to mesh it. All in mm.
/// Defaults: rabbit carotid artery [Holzapfel2000], coarse level.
struct ArteryOptions {
  double inner_radius = 1.43;
  double media = 0.26;       ///< thickness of the inner wall layer
  double adventitia = 0.13;  ///< thickness of the outer wall layer; 0: the wall is the media alone
  double length = 18;
  double size = 0.75;                ///< edge length in the cross-section of the lumen and around the wall
  std::optional<double> axial_size;  ///< edge length along the axis; as `size` unless given
};

/// Names of the levels, coarse first.
std::vector<std::string> artery_levels();

/// Element sizes of a level: node counts of the paper's meshes (1,034, 7,249 and 54,521) within a few percent.
/// Throws InputError for an unknown level, naming the nearest.
ArteryOptions artery_level(const std::string& name);

/// A conforming mesh with volumes `fluid`, `media`, `adventitia` and surfaces `inlet` (z = 0), `outlet`, `wall_ends`,
/// `outer`. Every node of an interface or of the outer face lies on its cylinder.
///
/// The cross-section (a hexagonal pattern of triangles bent into the disk, then rings of triangles) is extruded into
/// prisms, turned half a step from station to station and back, and each prism cut into three tetrahedra. Sizes are met
/// as nearly as whole numbers allow: the circumference has a multiple of six edges, never fewer than twelve; a layer is
/// cut into rings of about 0.35 `size`. Throws InputError with the fsi-mesh option at fault for dimensions that are not
/// positive and finite, for sizes that ask for more than `max_artery_nodes` nodes, or when all that gives a tetrahedron
/// of mean ratio below 1e-3.
TetrahedralMesh generate_artery(const ArteryOptions& options);

inline constexpr double max_artery_nodes = 2e7;

}  // namespace fsi
