#include "mesher/surface/flow_extension.hpp"

#include <algorithm>
#include <cmath>

#include "math/pi.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

/// For each node of a flat rim one on a circle of the rim's area around its centre, at angles as far apart as the nodes
/// are along the rim, turned so that together they move least.
std::vector<Point> circle_for(const std::vector<Point>& nodes, const std::vector<int>& rim, const LoopPlane& plane) {
  const std::size_t count = rim.size();
  const Point first = nodes[rim[0]] - plane.centre;
  const Point u = (1 / norm(first)) * first, v = cross(plane.normal, u);
  std::vector<double> along{0};
  for (std::size_t i = 0; i < count; ++i)
    along.push_back(along.back() + distance(nodes[rim[i]], nodes[rim[(i + 1) % count]]));
  double sine = 0, cosine = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Point x = nodes[rim[i]] - plane.centre;
    const double lag = std::atan2(dot(x, v), dot(x, u)) - 2 * pi * along[i] / along[count];
    sine += std::sin(lag);
    cosine += std::cos(lag);
  }
  const double turn = std::atan2(sine, cosine), radius = std::sqrt(plane.area / pi);
  std::vector<Point> circle;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = turn + 2 * pi * along[i] / along[count];
    circle.push_back(plane.centre + radius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return circle;
}

}  // namespace

void extend(TriangleSurface& surface, LumenOpening& opening, double diameters) {
  const auto rim = rim_of(surface, opening);
  const LoopPlane plane = plane_of(surface.nodes, rim);
  const auto circle = circle_for(surface.nodes, rim, plane);
  const std::size_t count = rim.size();
  double edge = 0;
  for (std::size_t i = 0; i < count; ++i)
    edge += distance(surface.nodes[rim[i]], surface.nodes[rim[(i + 1) % count]]) / static_cast<double>(count);
  const double length = diameters * opening.diameter(), blend = std::min(length, opening.diameter());
  const int rings = std::max(2, static_cast<int>(std::lround(length / edge)));
  std::vector<int> below = rim;
  for (int ring = 1; ring <= rings; ++ring) {
    const double at = length * ring / rings, s = std::min(1.0, at / blend), share = s * s * (3 - 2 * s);
    std::vector<int> above;
    for (std::size_t i = 0; i < count; ++i) {
      above.push_back(static_cast<int>(surface.nodes.size()));
      const Point& start = surface.nodes[rim[i]];
      surface.nodes.push_back(start + share * (circle[i] - start) + at * opening.normal);
    }
    // The rim is walked with the surface on its left, so that the new triangles run through its edges the other way.
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t j = (i + 1) % count;
      const bool odd = (static_cast<std::size_t>(ring) + i) % 2 == 1;
      if (odd) {
        surface.triangles.push_back({below[j], below[i], above[i]});
        surface.triangles.push_back({below[j], above[i], above[j]});
      } else {
        surface.triangles.push_back({below[j], below[i], above[j]});
        surface.triangles.push_back({below[i], above[i], above[j]});
      }
    }
    below = std::move(above);
  }
  opening.centre = opening.centre + length * opening.normal;
  rim_of(surface, opening);
}

}  // namespace fsi
