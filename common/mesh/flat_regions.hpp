#pragma once

#include <array>
#include <utility>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

using SurfaceTriangle = std::array<int, 3>;  ///< nodes, seen from outside counter-clockwise

/// A flat part of a closed surface that stands out from what is around it, as the cap over the opening of a lumen does.
struct FlatRegion {
  std::vector<int> triangles;  ///< ascending
  Point centre;                ///< mm
  Point normal;                ///< unit, outward
  double area = 0;             ///< mm^2
  double edge = 0;             ///< mean length of its edges, mm
};

/// The flat parts of a closed surface of triangles, largest first. A part is found by its plane and by its rim:
/// - its nodes lie within a quarter of the edges' length of the least-squares plane, and its triangles face along the
///   plane's normal: nodes of segmented surfaces are off by a tenth of an edge. Of long triangles 1.5 times the
///   shortest edge counts as that length;
/// - it has one rim, a closed line of five edges or more, with 4 pi area / length^2 of 0.4 or more;
/// - along 0.9 of the rim the surface has a crease of more than 30 degrees, on average of 60 or more, to the inner side
///   of the plane. A strip of a coarse tube's side turns by less. Where two branches meet (the carina), the surface
///   rises out of any plane in one direction, however flat it is.
std::vector<FlatRegion> flat_regions(const std::vector<Point>& nodes, const std::vector<SurfaceTriangle>& triangles);

/// Whether edges make one closed line: every node has two of them, and one walk takes all.
/// \param edges  their ends, in either direction
bool is_one_line(const std::vector<std::pair<int, int>>& edges);

}  // namespace fsi
