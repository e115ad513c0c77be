#include "mesher/offset_normals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

using Facet = TetrahedralMesh::Facet;

/// Vertex normals of any length by [Max1999]'s weights sin(angle) / (|e1| |e2|): the cross product over the squared
/// edges.
std::map<int, Point> vertex_normals(const std::vector<Point>& nodes, const std::vector<Facet>& facets) {
  std::map<int, Point> normals;
  for (const auto& facet : facets)
    for (int k = 0; k < 3; ++k) {
      const Point& at = nodes[facet[k]];
      const Point u = nodes[facet[(k + 1) % 3]] - at, v = nodes[facet[(k + 2) % 3]] - at;
      auto& normal = normals.try_emplace(facet[k], Point{0, 0, 0}).first->second;
      normal = normal + (1 / (dot(u, u) * dot(v, v))) * cross(u, v);
    }
  return normals;
}

/// Edges that one facet has, with the direction that it runs through them.
std::vector<RimEdge> one_facet_edges(const std::vector<Point>& nodes, const std::vector<Facet>& facets) {
  std::map<RimEdge, int> uses;
  for (const auto& facet : facets)
    for (int k = 0; k < 3; ++k) ++uses[std::minmax(facet[k], facet[(k + 1) % 3])];
  std::vector<RimEdge> rim;
  for (const auto& facet : facets)
    for (int k = 0; k < 3; ++k) {
      const int a = facet[k], b = facet[(k + 1) % 3];
      const int count = uses[std::minmax(a, b)];
      if (count == 1) rim.emplace_back(a, b);
      if (count > 2)
        throw InputError("fsi-mesh",
                         fmt::format("edge at ({:.4g}, {:.4g}, {:.4g}) mm", nodes[a][0], nodes[a][1], nodes[a][2]),
                         fmt::format("{} facets of the surface meet there", count), "mend the surface");
    }
  return rim;
}

Point unit(const Point& v) {
  return (1 / norm(v)) * v;
}

/// Makes normals unit, averaged with their neighbours', and on rims in the plane of the opening.
void smooth(std::map<int, Point>& normals, const std::vector<Facet>& facets, const NodePlanes& planes, int times) {
  std::map<int, std::set<int>> neighbours;
  for (const auto& facet : facets)
    for (int k = 0; k < 3; ++k) {
      neighbours[facet[k]].insert(facet[(k + 1) % 3]);
      neighbours[facet[k]].insert(facet[(k + 2) % 3]);
    }
  const auto lay_into_planes = [&] {
    for (auto& [node, normal] : normals) {
      const auto plane = planes.find(node);
      if (plane != planes.end()) normal = in_planes(normal, plane->second);
      normal = unit(normal);
    }
  };
  lay_into_planes();
  for (int i = 0; i < times; ++i) {
    auto old = normals;
    for (auto& [node, normal] : normals) {
      Point sum{0, 0, 0};
      for (const int next : neighbours[node]) sum = sum + old[next];
      normal = old[node] + (1.0 / static_cast<double>(neighbours[node].size())) * sum;
    }
    lay_into_planes();
  }
}
}  // namespace

OffsetNormals offset_normals(const std::vector<Point>& nodes, const std::vector<Facet>& facets, int smoothing,
                             const RimSides& sides) {
  OffsetNormals found{vertex_normals(nodes, facets), one_facet_edges(nodes, facets), {}};
  found.planes = rim_planes(nodes, found.rim, sides);
  smooth(found.normals, facets, found.planes, smoothing);
  return found;
}

}  // namespace fsi
