#pragma once

#include <array>
#include <utility>
#include <vector>

#include "mesh/flat_regions.hpp"
#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// A surface of triangles that share nodes. Each edge has one triangle, on a rim, or two that run through it in
/// opposite directions; mesher/surface/sound_surface.hpp makes such a surface of what a file holds.
struct TriangleSurface {
  std::vector<Point> nodes;                ///< mm
  std::vector<SurfaceTriangle> triangles;  ///< seen from outside counter-clockwise
};

using SurfaceEdge = std::pair<int, int>;  ///< nodes

/// The rims of an open surface: nodes of each, in the direction in which the triangles run through its edges; those of
/// most nodes first.
std::vector<std::vector<int>> rims_of(const TriangleSurface& surface);

/// Neighbours of each node by edges, ascending; on a rim those on the rim alone.
std::vector<std::vector<int>> neighbours_of(const TriangleSurface& surface);

/// The sum of the area vectors of each node's triangles, mm^2: along the normal there.
std::vector<Point> area_vectors_at_nodes(const TriangleSurface& surface);

/// Volume within the surface, each rim closed by triangles to its centre (plane_of()), mm^3; positive when normals
/// point outwards.
double enclosed_volume(const TriangleSurface& surface);

/// Mean length of the triangles' sides, mm; 0 without triangles.
double mean_edge(const TriangleSurface& surface);

/// The part of a surface that some of its triangles make, without the nodes that no longer have one.
/// \param keep  per triangle
TriangleSurface part_of(const TriangleSurface& surface, const std::vector<char>& keep);

/// The plane of a closed line of nodes: unit normal by the right-hand rule, centre and area of what is inside, and how
/// far its nodes are off.
struct LoopPlane {
  Point centre, normal;
  double area = 0;       ///< mm^2
  double off_plane = 0;  ///< mm, the farthest node
};
LoopPlane plane_of(const std::vector<Point>& nodes, const std::vector<int>& loop);

}  // namespace fsi
