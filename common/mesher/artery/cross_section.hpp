#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesher/artery/options.hpp"

namespace fsi {

/// A triangulated cross-section of lumen and wall, or a sector of one. Its nodes lie on rings about the centre.
struct CrossSection {
  /// At angle 2 pi step / steps; the centre has steps = 0.
  struct Node {
    double radius;
    int step, steps;
    int ring;  ///< number of its ring, 0 the centre
  };
  /// Edges of the boundary, the section to their left.
  struct Edges {
    std::string name;  ///< of the surface that they become
    std::vector<std::array<int, 2>> edges;
  };
  std::vector<Node> nodes;                    ///< from the centre outwards
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise
  std::vector<int> region;                    ///< per triangle: 0 fluid, 1 media, 2 adventitia
  std::vector<Edges> sides;                   ///< `outer`, then the planes of symmetry
};

/// The section of the levels: a hexagonal pattern of triangles bent into the disk (ring k has 6k nodes), then rings of
/// the layers with alternating diagonals. `around` must be six times `lumen`; gradings have no effect.
CrossSection hexagonal_section(const ArteryShape& shape, const ArteryCells& cells);

/// A section of any numbers of cells, graded to the wall, from the angle 0 to `degrees`. The first ring has about six
/// cells in the whole circle, the next ones gain as many each until they have `around`; cells between rings of equal
/// count are quadrilaterals cut in two with alternating diagonals, others triangles that join nearest nodes.
///
/// `degrees` is 360, or a whole part of it for a sector between planes of symmetry. Their edges are the sides
/// `symmetry_y` (the plane y = 0) and, but for 180 degrees, that of the plane at `degrees`: `symmetry_x` (x = 0, of 90
/// degrees) or `symmetry_1`. The section and its images in these planes fit together. Throws as require_cells(), and
/// InputError with the fsi-mesh option at fault for other sectors and for `around` that a sector does not cut into at
/// least two whole cells.
CrossSection ring_section(const ArteryShape& shape, const ArteryCells& cells, int degrees = 360);

}  // namespace fsi
