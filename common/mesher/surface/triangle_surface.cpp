#include "mesher/surface/triangle_surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "mesh/point_math.hpp"

namespace fsi {

namespace {

/// The edges with one triangle: from each node to the next.
std::map<int, int> rim_edges(const TriangleSurface& surface) {
  std::set<SurfaceEdge> directed;
  for (const auto& t : surface.triangles)
    for (int k = 0; k < 3; ++k) directed.emplace(t[k], t[(k + 1) % 3]);
  std::map<int, int> next;
  for (const auto& [a, b] : directed)
    if (directed.count({b, a}) == 0) next[a] = b;
  return next;
}

}  // namespace

std::vector<std::vector<int>> rims_of(const TriangleSurface& surface) {
  auto next = rim_edges(surface);
  std::vector<std::vector<int>> rims;
  while (!next.empty()) {
    std::vector<int> rim;
    for (auto at = next.begin(); at != next.end(); at = next.find(rim.back())) {
      if (rim.empty()) rim.push_back(at->first);
      rim.push_back(at->second);
      next.erase(at);
    }
    rim.pop_back();  // the first again
    rims.push_back(std::move(rim));
  }
  std::stable_sort(rims.begin(), rims.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return rims;
}

std::vector<std::vector<int>> neighbours_of(const TriangleSurface& surface) {
  std::vector<std::set<int>> all(surface.nodes.size());
  for (const auto& t : surface.triangles)
    for (int k = 0; k < 3; ++k) {
      all[t[k]].insert(t[(k + 1) % 3]);
      all[t[(k + 1) % 3]].insert(t[k]);
    }
  for (const auto& rim : rims_of(surface))
    for (std::size_t i = 0; i < rim.size(); ++i)
      all[rim[i]] = {rim[(i + rim.size() - 1) % rim.size()], rim[(i + 1) % rim.size()]};
  std::vector<std::vector<int>> neighbours;
  neighbours.reserve(all.size());
  for (const auto& found : all) neighbours.emplace_back(found.begin(), found.end());
  return neighbours;
}

std::vector<Point> area_vectors_at_nodes(const TriangleSurface& surface) {
  std::vector<Point> vectors(surface.nodes.size(), Point{0, 0, 0});
  for (const auto& [a, b, c] : surface.triangles)
    for (const int node : {a, b, c})
      vectors[node] = vectors[node] + triangle_area_vector(surface.nodes[a], surface.nodes[b], surface.nodes[c]);
  return vectors;
}

double enclosed_volume(const TriangleSurface& surface) {
  const auto& x = surface.nodes;
  const Point origin = x.empty() ? Point{0, 0, 0} : x.front();
  double volume = 0;
  for (const auto& [a, b, c] : surface.triangles) volume += tetrahedron_volume(origin, x[a], x[b], x[c]);
  for (const auto& rim : rims_of(surface)) {
    const Point centre = plane_of(x, rim).centre;
    for (std::size_t i = 0; i < rim.size(); ++i)
      volume += tetrahedron_volume(origin, x[rim[(i + 1) % rim.size()]], x[rim[i]], centre);
  }
  return volume;
}

double mean_edge(const TriangleSurface& surface) {
  double sum = 0;
  for (const auto& t : surface.triangles)
    for (int k = 0; k < 3; ++k) sum += distance(surface.nodes[t[k]], surface.nodes[t[(k + 1) % 3]]);
  return surface.triangles.empty() ? 0 : sum / (3.0 * static_cast<double>(surface.triangles.size()));
}

TriangleSurface part_of(const TriangleSurface& surface, const std::vector<char>& keep) {
  TriangleSurface part;
  std::vector<int> number(surface.nodes.size(), -1);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (!keep[t]) continue;
    auto triangle = surface.triangles[t];
    for (int& node : triangle) {
      if (number[node] < 0) {
        number[node] = static_cast<int>(part.nodes.size());
        part.nodes.push_back(surface.nodes[node]);
      }
      node = number[node];
    }
    part.triangles.push_back(triangle);
  }
  return part;
}

LoopPlane plane_of(const std::vector<Point>& nodes, const std::vector<int>& loop) {
  LoopPlane plane{{0, 0, 0}, {0, 0, 0}};
  Point mean{0, 0, 0}, area{0, 0, 0};
  for (const int node : loop) mean = mean + (1.0 / static_cast<double>(loop.size())) * nodes[node];
  const auto each_triangle = [&](auto use) {
    for (std::size_t i = 0; i < loop.size(); ++i) use(nodes[loop[i]], nodes[loop[(i + 1) % loop.size()]]);
  };
  each_triangle([&](const Point& a, const Point& b) { area = area + triangle_area_vector(mean, a, b); });
  plane.area = norm(area);
  plane.centre = mean;
  if (!(plane.area > 0)) return plane;
  plane.normal = (1 / plane.area) * area;
  each_triangle([&](const Point& a, const Point& b) {
    const double share = dot(triangle_area_vector(mean, a, b), plane.normal) / plane.area;
    plane.centre = plane.centre + (share / 3) * ((a - mean) + (b - mean));
  });
  for (const int node : loop)
    plane.off_plane = std::max(plane.off_plane, std::abs(dot(nodes[node] - plane.centre, plane.normal)));
  return plane;
}

}  // namespace fsi
