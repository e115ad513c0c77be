#pragma once

#include <map>
#include <vector>

#include "mesh/simplex_mesh.hpp"
#include "mesher/rim_planes.hpp"

namespace fsi {

/// Where an offset of an open surface goes.
struct OffsetNormals {
  std::map<int, Point> normals;  ///< unit, by node
  std::vector<RimEdge> rim;      ///< edges that one facet has
  NodePlanes planes;             ///< that the normals lie in, of the nodes of rims
};

/// Vertex normals by [Max1999]'s weights, which are those of a sphere or a cylinder up to rounding, averaged with their
/// neighbours'; on rims they lie in the plane of the opening there.
/// \param smoothing  times that they are averaged
/// \param sides      what lies beyond the rims, where that is not one opening a rim
/// \throws InputError for an edge of three facets or more, and for a rim that is not flat, with its place
OffsetNormals offset_normals(const std::vector<Point>& nodes, const std::vector<TetrahedralMesh::Facet>& facets,
                             int smoothing, const RimSides& sides = {});

}  // namespace fsi
