#include "mesh/offset_normals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

using Facet = TetrahedralMesh::Facet;

/// Unit vertex normals by Max's weights, sin(angle) / (|e1| |e2|): the cross product over the squared edges.
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

/// Unit normals of the planes that the rims lie in, per node of a rim.
std::map<int, Point> rim_planes(const std::vector<Point>& nodes, const std::vector<RimEdge>& rim) {
  // Distance from the plane over the rim's size, or over the mean of its edges where that allows more: the nodes of
  // segmented surfaces are off by a tenth of an edge.
  constexpr double flat = 0.02, uneven = 0.25;
  std::map<int, std::vector<int>> neighbours;
  for (const auto& [a, b] : rim) {
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
  }
  std::map<int, Point> planes;
  std::set<int> seen;
  for (const auto& [start, unused] : neighbours) {
    if (seen.count(start) > 0) continue;
    std::vector<int> loop{start};
    seen.insert(start);
    for (std::size_t i = 0; i < loop.size(); ++i)
      for (const int next : neighbours[loop[i]])
        if (seen.insert(next).second) loop.push_back(next);
    Point centre{0, 0, 0}, normal{0, 0, 0};
    for (const int node : loop) centre = centre + (1.0 / static_cast<double>(loop.size())) * nodes[node];
    const std::set<int> in_loop(loop.begin(), loop.end());
    double edge = 0;
    for (const auto& [a, b] : rim) {
      if (in_loop.count(a) == 0) continue;
      normal = normal + cross(nodes[a] - centre, nodes[b] - centre);
      edge += distance(nodes[a], nodes[b]) / static_cast<double>(loop.size());
    }
    const double length = norm(normal);
    double size = 0, off = 0;
    for (const int node : loop) {
      size = std::max(size, distance(nodes[node], centre));
      off = std::max(off, length > 0 ? std::abs(dot(nodes[node] - centre, normal)) / length : 1e300);
    }
    if (!(off <= std::max(flat * size, uneven * edge)))
      throw InputError("fsi-mesh", fmt::format("rim at ({:.4g}, {:.4g}, {:.4g}) mm", centre[0], centre[1], centre[2]),
                       fmt::format("is {:.2g} mm off a plane, so that the wall's end there would not be flat", off),
                       "cut the lumen's openings flat");
    for (const int node : loop) planes[node] = (1 / length) * normal;
  }
  return planes;
}

Point unit(const Point& v) {
  return (1 / norm(v)) * v;
}

/// Normals averaged with their neighbours', and laid into the plane of the opening on rims.
void smooth(std::map<int, Point>& normals, const std::vector<Facet>& facets, const std::map<int, Point>& planes,
            int times) {
  std::map<int, std::set<int>> neighbours;
  for (const auto& facet : facets)
    for (int k = 0; k < 3; ++k) {
      neighbours[facet[k]].insert(facet[(k + 1) % 3]);
      neighbours[facet[k]].insert(facet[(k + 2) % 3]);
    }
  const auto lay_into_planes = [&] {
    for (auto& [node, normal] : normals) {
      const auto plane = planes.find(node);
      if (plane != planes.end()) normal = normal - dot(normal, plane->second) * plane->second;
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

OffsetNormals offset_normals(const std::vector<Point>& nodes, const std::vector<Facet>& facets, int smoothing) {
  OffsetNormals found{vertex_normals(nodes, facets), one_facet_edges(nodes, facets)};
  smooth(found.normals, facets, rim_planes(nodes, found.rim), smoothing);
  return found;
}

}  // namespace fsi
