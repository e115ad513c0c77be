#pragma once

#include <optional>
#include <string>
#include <vector>

namespace fsi {

/// Dimensions of a straight two-layer artery along the z axis from (0,0,0), in mm.
/// Defaults: rabbit carotid artery [Holzapfel2000].
struct ArteryShape {
  double inner_radius = 1.43;
  double media = 0.26;       ///< thickness of the inner wall layer
  double adventitia = 0.13;  ///< thickness of the outer wall layer; 0: the wall is the media alone
  double length = 18;
};

/// How finely to mesh an artery, by sizes in mm. Default: the coarse level's size, along the axis too.
struct ArteryOptions : ArteryShape {
  double size = 0.75;                ///< edge length in the cross-section of the lumen and around the wall
  std::optional<double> axial_size;  ///< edge length along the axis; `size` unless given
};

/// How finely to mesh an artery, by whole numbers.
struct ArteryCells {
  int lumen = 4;       ///< from the axis to the inner wall
  int media = 2;       ///< through the inner wall layer
  int adventitia = 2;  ///< through the outer wall layer; without meaning where that has no thickness
  int around = 12;     ///< around the whole circumference of the wall
  int axial = 48;      ///< from inlet to outlet
  /// Length of the cell at the axis over that at the wall: above 1 the cells shrink towards the wall, by equal ratios.
  double lumen_grading = 1;
  /// Length of the cell at the outlet over that at the inlet: above 1 the cells shrink towards the inlet, by equal
  /// ratios.
  double axial_grading = 1;
};

/// Names of the levels, coarse first.
std::vector<std::string> artery_levels();

/// Element sizes of a level: node counts of the paper's meshes (1,034, 7,249 and 54,521) within a few percent.
/// Throws InputError for an unknown level, naming the nearest.
ArteryOptions artery_level(const std::string& name);

/// The whole numbers that the sizes come to: edges of `size` around and across the lumen, six around for each one
/// across and never fewer than twelve; layers cut into cells of about 0.35 `size`. Throws InputError with the fsi-mesh
/// option at fault for dimensions and sizes that are not positive and finite, and for sizes that ask for more than
/// `max_artery_nodes` nodes; OutOfMemory for more than fit into memory.
ArteryCells artery_cells(const ArteryOptions& options);

inline constexpr double max_artery_nodes = 2e7;

/// Throws InputError with the fsi-mesh option at fault for dimensions that are not positive and finite; `adventitia`
/// may be 0.
void require_tube(const ArteryShape& shape);

/// Throws InputError with the fsi-mesh option at fault for counts that are too small, gradings that are not positive
/// and finite or grade cells to less than a millionth of each other, for more than `max_artery_nodes` nodes, and as
/// require_tube(); OutOfMemory for more than fit into memory.
void require_cells(const ArteryShape& shape, const ArteryCells& cells);

}  // namespace fsi
