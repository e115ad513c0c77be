#include "mesher/surface/domed_ends.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "math/pi.hpp"
#include "mesh/disjoint_sets.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

constexpr double crease = pi / 6, crease_on_average = pi / 3;
constexpr double one_way = 0.9;    // length of the mean normal
constexpr double roundness = 0.4;  // 4 pi area / rim^2; 0.59 of a rectangle of three by one
constexpr double flat = 0.99939;   // cosine of 2 degrees
constexpr std::size_t fewest_edges = 5;

struct Side {
  std::pair<int, int> nodes;
  int triangle;
};

struct Joint {
  std::pair<int, int> nodes;
  std::array<int, 2> triangles;
  double angle;  ///< radians between the normals; negative where the surface turns outwards
};

struct Part {
  std::vector<int> triangles;
  Point area{0, 0, 0}, centre{0, 0, 0};
  double size = 0, rim = 0, angles = 0;
  std::size_t edges = 0;
  std::vector<std::pair<int, int>> rim_edges;
  bool free = true;
};

Point area_vector(const TriangleSurface& surface, int t) {
  const auto& [a, b, c] = surface.triangles[t];
  return triangle_area_vector(surface.nodes[a], surface.nodes[b], surface.nodes[c]);
}

std::vector<Joint> joints_of(const TriangleSurface& surface, const std::vector<Point>& area) {
  std::vector<Side> sides;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      sides.push_back({std::minmax(surface.triangles[t][k], surface.triangles[t][(k + 1) % 3]), static_cast<int>(t)});
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::pair(a.nodes, a.triangle) < std::pair(b.nodes, b.triangle);
  });
  std::vector<Joint> joints;
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    if (sides[i].nodes != sides[i + 1].nodes) continue;
    const int a = sides[i].triangle, b = sides[i + 1].triangle;
    double angle = std::atan2(norm(cross(area[a], area[b])), dot(area[a], area[b])), height = 0;
    for (const int node : surface.triangles[b])
      height += dot(area[a], surface.nodes[node] - surface.nodes[sides[i].nodes.first]);
    joints.push_back({sides[i].nodes, {a, b}, height > 0 ? -angle : angle});
  }
  return joints;
}

bool is_end(const Part& part, const std::vector<Point>& area) {
  if (!part.free || part.edges < fewest_edges || !(norm(part.area) > one_way * part.size)) return false;
  if (part.angles < crease_on_average * part.rim) return false;
  if (4 * pi * norm(part.area) < roundness * part.rim * part.rim || !is_one_line(part.rim_edges)) return false;
  return std::any_of(part.triangles.begin(), part.triangles.end(),
                     [&](int t) { return dot(area[t], part.area) < flat * norm(area[t]) * norm(part.area); });
}

}  // namespace

std::vector<DomedEnd> domed_ends(const TriangleSurface& surface, const std::vector<char>& taken) {
  std::vector<Point> area;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) area.push_back(area_vector(surface, static_cast<int>(t)));
  const auto joints = joints_of(surface, area);
  DisjointSets sets(surface.triangles.size());
  for (const auto& joint : joints)
    if (std::abs(joint.angle) < crease) sets.join(joint.triangles[0], joint.triangles[1]);
  std::vector<Part> parts(surface.triangles.size());
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const auto t = static_cast<int>(i);
    Part& part = parts[sets.root(t)];
    part.triangles.push_back(t);
    part.area = part.area + area[t];
    part.size += norm(area[t]);
    for (const int node : surface.triangles[t]) part.centre = part.centre + (norm(area[t]) / 3) * surface.nodes[node];
    part.free = part.free && taken[i] == 0;
  }
  for (const auto& joint : joints) {
    const int roots[2] = {sets.root(joint.triangles[0]), sets.root(joint.triangles[1])};
    if (roots[0] == roots[1]) continue;
    const double length = distance(surface.nodes[joint.nodes.first], surface.nodes[joint.nodes.second]);
    for (const int root : roots) {
      Part& part = parts[root];
      ++part.edges;
      part.rim += length;
      part.angles += std::max(0.0, joint.angle) * length;
      part.rim_edges.push_back(joint.nodes);
    }
  }
  std::vector<DomedEnd> found;
  for (auto& part : parts)
    if (!part.triangles.empty() && is_end(part, area))
      found.push_back({std::move(part.triangles), (1 / part.size) * part.centre});
  return found;
}

}  // namespace fsi
