#pragma once

#include <map>
#include <utility>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

using RimEdge = std::pair<int, int>;  ///< nodes, in the direction in which the facet runs through them

/// What lies beyond a rim: for each of its edges (smaller node first) the number of a surface, which has a normal.
/// Edges that are not there belong to one surface without a normal.
struct RimSides {
  std::map<RimEdge, int> surface;
  std::vector<Point> normals;  ///< unit, by that number
};

/// Unit normals, perpendicular to each other, of the planes that the nodes of rims lie in: one per node, two where two
/// surfaces meet, as an opening and a plane of symmetry do.
using NodePlanes = std::map<int, std::vector<Point>>;

/// A rim that runs around one surface lies in the plane that fits it; a part of one lies in the plane of its surface.
/// \throws InputError for a rim that is not flat, with its place
NodePlanes rim_planes(const std::vector<Point>& nodes, const std::vector<RimEdge>& rim, const RimSides& sides = {});

/// The plane that an edge of a rim lies in, by its unit normal; none where its ends are in none.
std::vector<Point> plane_of_rim_edge(const NodePlanes& planes, const RimEdge& edge);

/// The part of a vector that lies in the planes.
Point in_planes(Point v, const std::vector<Point>& planes);

}  // namespace fsi
