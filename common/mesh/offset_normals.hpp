#pragma once

#include <map>
#include <utility>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

using RimEdge = std::pair<int, int>;  ///< nodes, in the direction in which the facet runs through them

/// Where an offset of an open surface goes.
struct OffsetNormals {
  std::map<int, Point> normals;  ///< unit, by node
  std::vector<RimEdge> rim;      ///< edges that one facet has
};

/// Vertex normals by [Max1999]'s weights, which are those of a sphere or a cylinder up to rounding, averaged with their
/// neighbours'; on rims they lie in the plane of the opening there.
/// \param smoothing  times that they are averaged
/// \throws InputError for an edge of three facets, and for a rim that is not flat, with its place
OffsetNormals offset_normals(const std::vector<Point>& nodes, const std::vector<TetrahedralMesh::Facet>& facets,
                             int smoothing);

}  // namespace fsi
