#include "mesher/rim_planes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>

#include "base/error.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

/// Edges that hang together, all of one surface.
struct Chain {
  int surface = -1;
  std::vector<RimEdge> edges;
  std::vector<int> nodes;
  bool closed = true;  ///< each node has two of the edges
};

std::vector<Chain> chains_of(const std::vector<RimEdge>& rim, const RimSides& sides) {
  std::map<int, std::vector<RimEdge>> of_surface;
  for (const auto& edge : rim) {
    const auto found = sides.surface.find(std::minmax(edge.first, edge.second));
    of_surface[found == sides.surface.end() ? -1 : found->second].push_back(edge);
  }
  std::vector<Chain> chains;
  for (const auto& [surface, edges] : of_surface) {
    std::map<int, std::vector<std::size_t>> at;
    for (std::size_t e = 0; e < edges.size(); ++e)
      for (const int node : {edges[e].first, edges[e].second}) at[node].push_back(e);
    std::set<int> seen;
    for (const auto& [start, unused] : at) {
      if (!seen.insert(start).second) continue;
      Chain chain;
      chain.surface = surface;
      chain.nodes.push_back(start);
      std::set<std::size_t> taken;
      for (std::size_t i = 0; i < chain.nodes.size(); ++i) {
        const auto& here = at[chain.nodes[i]];
        chain.closed = chain.closed && here.size() == 2;
        for (const std::size_t e : here) {
          if (taken.insert(e).second) chain.edges.push_back(edges[e]);
          for (const int node : {edges[e].first, edges[e].second})
            if (seen.insert(node).second) chain.nodes.push_back(node);
        }
      }
      chains.push_back(std::move(chain));
    }
  }
  return chains;
}

/// The plane's normal. \throws InputError for nodes that are off it
Point plane_of(const std::vector<Point>& nodes, const Chain& chain, const RimSides& sides) {
  // Distance from the plane over the rim's size, or over the mean of its edges where that allows more: the nodes of
  // segmented surfaces are off by a tenth of an edge.
  constexpr double flat = 0.02, uneven = 0.25;
  Point centre{0, 0, 0}, normal{0, 0, 0};
  for (const int node : chain.nodes) centre = centre + (1.0 / static_cast<double>(chain.nodes.size())) * nodes[node];
  double edge = 0;
  for (const auto& [a, b] : chain.edges) {
    normal = normal + cross(nodes[a] - centre, nodes[b] - centre);
    edge += distance(nodes[a], nodes[b]) / static_cast<double>(chain.edges.size());
  }
  if (!chain.closed && chain.surface >= 0) normal = sides.normals[chain.surface];
  const double length = norm(normal);
  double size = 0, off = 0;
  for (const int node : chain.nodes) {
    size = std::max(size, distance(nodes[node], centre));
    off = std::max(off, length > 0 ? std::abs(dot(nodes[node] - centre, normal)) / length : 1e300);
  }
  if (!(off <= std::max(flat * size, uneven * edge)))
    throw InputError("fsi-mesh", fmt::format("rim at ({:.4g}, {:.4g}, {:.4g}) mm", centre[0], centre[1], centre[2]),
                     fmt::format("is {:.2g} mm off a plane, so that the wall's end there would not be flat", off),
                     "cut the lumen's openings flat");
  return (1 / length) * normal;
}

}  // namespace

Point in_planes(Point v, const std::vector<Point>& planes) {
  for (const Point& normal : planes) v = v - dot(v, normal) * normal;
  return v;
}

std::vector<Point> plane_of_rim_edge(const NodePlanes& planes, const RimEdge& edge) {
  constexpr double same = 0.98;  // cosine
  const auto one = planes.find(edge.first), other = planes.find(edge.second);
  if (one == planes.end() || other == planes.end()) return {};
  for (const auto* end : {&one->second, &other->second})
    if (end->size() == 1) return *end;
  for (const Point& p : one->second)
    for (const Point& q : other->second)
      if (std::abs(dot(p, q)) > same) return {p};
  return {};
}

NodePlanes rim_planes(const std::vector<Point>& nodes, const std::vector<RimEdge>& rim, const RimSides& sides) {
  constexpr double same = 0.2;  // sine of the angle between two planes that are one
  NodePlanes planes;
  for (const auto& chain : chains_of(rim, sides)) {
    const Point normal = plane_of(nodes, chain, sides);
    for (const int node : chain.nodes) {
      auto& here = planes[node];
      const Point new_part = in_planes(normal, here);
      if (here.size() < 2 && norm(new_part) > same) here.push_back((1 / norm(new_part)) * new_part);
    }
  }
  return planes;
}

}  // namespace fsi
