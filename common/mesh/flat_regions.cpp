#include "mesh/flat_regions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <set>
#include <unordered_map>
#include <utility>

#include "base/sort_unique.hpp"
#include "math/pi.hpp"
#include "mesh/disjoint_sets.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

constexpr double off_plane = 0.25;  // of a triangle's size(): nodes that are off by a tenth, twice over
constexpr double facing = 0.64;     // cosine of 50 degrees: triangles of such nodes lean by 20 at most
constexpr double sharp = pi / 6, sharp_on_average = pi / 3;
constexpr double sharp_part = 0.9;       // of the rim's length
constexpr double roundness = 0.4;        // 4 pi area / rim^2; 0.59 of a rectangle of three by one, 1 of a disk
constexpr std::size_t fewest_edges = 5;  // of a rim
constexpr int most_fits = 20;            // of a plane; what still changes then is no plane

struct Plane {
  Point at, normal;
  double height(const Point& x) const { return dot(x - at, normal); }
};

class FlatRegions {
 public:
  FlatRegions(const std::vector<Point>& nodes, const std::vector<SurfaceTriangle>& triangles)
      : nodes_(nodes), triangles_(triangles), neighbours_(triangles.size(), {-1, -1, -1}) {
    std::map<std::pair<int, int>, std::pair<int, int>> open;  // edge: triangle and side
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto& [a, b, c] = triangles[t];
      area_.push_back(triangle_area_vector(nodes[a], nodes[b], nodes[c]));
      double length = 0;
      for (int k = 0; k < 3; ++k) {
        const int i = triangles[t][k], j = triangles[t][(k + 1) % 3];
        length += distance(nodes[i], nodes[j]) / 3;
        around_[triangles[t][k]].push_back(static_cast<int>(t));
        const auto [known, is_new] = open.try_emplace(std::minmax(i, j), static_cast<int>(t), k);
        if (is_new) continue;
        neighbours_[t][k] = known->second.first;
        neighbours_[known->second.first][known->second.second] = static_cast<int>(t);
      }
      edge_.push_back(length);
      size_.push_back(size(triangles[t], length));
    }
  }

  std::vector<FlatRegion> find() {
    std::vector<FlatRegion> found;
    seen_.assign(triangles_.size(), 0);
    for (const int seed : by_flatness()) {
      if (seen_[seed]) continue;
      const auto region = grown_from(seed);
      for (const int t : region) seen_[t] = 1;
      seen_[seed] = 1;
      if (region.empty() || !stands_out(region)) continue;
      found.push_back(described(region));
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.area > b.area; });
    return found;
  }

 private:
  /// The mean edge; of long triangles 1.5 times the shortest, else strips of a tube's side would pass for flat.
  double size(const SurfaceTriangle& t, double mean_edge) const {
    double shortest = mean_edge;
    for (int k = 0; k < 3; ++k) shortest = std::min(shortest, distance(nodes_[t[k]], nodes_[t[(k + 1) % 3]]));
    return std::min(mean_edge, 1.5 * shortest);
  }

  Point normal_around(int node) const {
    Point sum{0, 0, 0};
    for (const int t : around_.at(node)) sum = sum + area_[t];
    return sum;
  }

  /// Triangles in the order in which planes are tried: the flattest neighbourhoods first, which lie inside flat parts.
  std::vector<int> by_flatness() const {
    std::unordered_map<int, Point> normals;
    for (const auto& [node, unused] : around_) normals[node] = normal_around(node);
    std::vector<double> bent(triangles_.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      Point mean{0, 0, 0};
      for (const int node : triangles_[t]) mean = mean + normals[node];
      for (const int node : triangles_[t])
        bent[t] = std::max(bent[t], 1 - dot(mean, normals[node]) / (norm(mean) * norm(normals[node])));
    }
    std::vector<int> order(triangles_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return bent[a] < bent[b]; });
    return order;
  }

  bool lies_in(int t, const Plane& plane) const {
    if (dot(area_[t], plane.normal) < facing * norm(area_[t])) return false;
    return std::all_of(triangles_[t].begin(), triangles_[t].end(),
                       [&](int node) { return std::abs(plane.height(nodes_[node])) <= off_plane * size_[t]; });
  }

  /// Triangles connected with the seed that lie in a plane which is fitted to them; empty when there is no such plane.
  std::vector<int> grown_from(int seed) const {
    const auto& [a, b, c] = triangles_[seed];
    Plane plane{(1.0 / 3) * (nodes_[a] + nodes_[b] + nodes_[c]), (1 / norm(area_[seed])) * area_[seed]};
    std::vector<int> region;
    for (int fit = 0; fit < most_fits; ++fit) {
      auto now = connected(seed, plane);
      if (now.empty() || now == region) return now;
      region = std::move(now);
      plane = fitted(region);
    }
    return {};
  }

  std::vector<int> connected(int seed, const Plane& plane) const {
    if (!lies_in(seed, plane)) return {};
    std::vector<int> region{seed};
    std::set<int> in{seed};
    for (std::size_t i = 0; i < region.size(); ++i)
      for (const int next : neighbours_[region[i]])
        if (next >= 0 && in.count(next) == 0 && lies_in(next, plane)) {
          in.insert(next);
          region.push_back(next);
        }
    fill(in);
    return {in.begin(), in.end()};
  }

  /// Triangles with all neighbours inside belong to it, too: a node that is far off tilts those around it.
  void fill(std::set<int>& in) const {
    std::vector<int> more;
    for (const int t : in)
      for (const int next : neighbours_[t])
        if (next >= 0 && in.count(next) == 0 &&
            std::all_of(neighbours_[next].begin(), neighbours_[next].end(), [&](int n) { return in.count(n) > 0; }))
          more.push_back(next);
    in.insert(more.begin(), more.end());
  }

  std::set<int> nodes_of(const std::vector<int>& region) const {
    std::set<int> found;
    for (const int t : region) found.insert(triangles_[t].begin(), triangles_[t].end());
    return found;
  }

  /// The plane of least squares through the nodes: along the mean normal n of the triangles heights are a linear
  /// function of two coordinates across it, whose slopes turn n.
  Plane fitted(const std::vector<int>& region) const {
    Point normal{0, 0, 0}, at{0, 0, 0};
    for (const int t : region) normal = normal + area_[t];
    normal = (1 / norm(normal)) * normal;
    const auto on = nodes_of(region);
    for (const int node : on) at = at + (1.0 / static_cast<double>(on.size())) * nodes_[node];
    const Point u = across(normal), v = cross(normal, u);
    double uu = 0, uv = 0, vv = 0, uh = 0, vh = 0;
    for (const int node : on) {
      const Point x = nodes_[node] - at;
      const double p = dot(x, u), q = dot(x, v), h = dot(x, normal);
      uu += p * p;
      uv += p * q;
      vv += q * q;
      uh += p * h;
      vh += q * h;
    }
    const double det = uu * vv - uv * uv;
    if (det > 1e-12 * uu * vv) normal = normal - ((uh * vv - vh * uv) / det) * u - ((vh * uu - uh * uv) / det) * v;
    return {at, (1 / norm(normal)) * normal};
  }

  static Point across(const Point& normal) {
    Point axis{0, 0, 0};
    int least = 0;
    for (int k = 1; k < 3; ++k)
      if (std::abs(normal[k]) < std::abs(normal[least])) least = k;
    axis[least] = 1;
    const Point u = cross(normal, axis);
    return (1 / norm(u)) * u;
  }

  /// Whether its rim is that of a cap.
  bool stands_out(const std::vector<int>& region) const {
    const Plane plane = fitted(region);
    const std::set<int> in(region.begin(), region.end());
    std::vector<std::pair<int, int>> rim;
    double area = 0;
    for (const int t : region) {
      area += dot(area_[t], plane.normal);
      for (int k = 0; k < 3; ++k)
        if (in.count(neighbours_[t][k]) == 0) rim.emplace_back(triangles_[t][k], triangles_[t][(k + 1) % 3]);
    }
    if (rim.size() < fewest_edges || !is_one_line(rim)) return false;
    double length = 0, turned = 0, angles = 0;
    for (const auto& [a, b] : rim) {
      const double edge = distance(nodes_[a], nodes_[b]), angle = angle_behind(a, b, in, plane);
      length += edge;
      angles += angle * edge;
      if (angle > sharp) turned += edge;
    }
    return turned >= sharp_part * length && angles >= sharp_on_average * length &&
           4 * pi * area >= roundness * length * length;
  }

  /// By how much the surface turns away to the inner side of the plane at an edge of the rim, radians; 0 when it does
  /// not. Normals are the means of the triangles inside and outside that meet the edge: a strip of a tube's side is
  /// bent itself, and does not end in a crease.
  double angle_behind(int a, int b, const std::set<int>& in, const Plane& plane) const {
    Point inside{0, 0, 0}, outside{0, 0, 0};
    double height = 0;
    for (const int node : {a, b})
      for (const int t : around_.at(node)) {
        if (in.count(t) > 0) {
          inside = inside + area_[t];
          continue;
        }
        outside = outside + area_[t];
        for (const int other : triangles_[t]) height += plane.height(nodes_[other]);
      }
    return height < 0 ? std::atan2(norm(cross(inside, outside)), dot(inside, outside)) : 0;
  }

  FlatRegion described(const std::vector<int>& region) const {
    FlatRegion flat{region, {0, 0, 0}, fitted(region).normal};
    for (const int t : region) {
      const double weight = norm(area_[t]);
      flat.area += weight;
      flat.edge += edge_[t] / static_cast<double>(region.size());
      for (const int node : triangles_[t]) flat.centre = flat.centre + (weight / 3) * nodes_[node];
    }
    flat.centre = (1 / flat.area) * flat.centre;
    return flat;
  }

  const std::vector<Point>& nodes_;
  const std::vector<SurfaceTriangle>& triangles_;
  std::vector<std::array<int, 3>> neighbours_;        ///< across the side from a node to the next
  std::vector<Point> area_;                           ///< vectors, mm^2
  std::vector<double> edge_, size_;                   ///< mean lengths, and size(), mm
  std::unordered_map<int, std::vector<int>> around_;  ///< the triangles at a node
  std::vector<char> seen_;
};

}  // namespace

bool is_one_line(const std::vector<std::pair<int, int>>& edges) {
  std::vector<int> nodes;
  for (const auto& [a, b] : edges) nodes.insert(nodes.end(), {a, b});
  std::sort(nodes.begin(), nodes.end());
  for (std::size_t i = 0; i < nodes.size(); i += 2)
    if (nodes[i] != nodes[i + 1] || (i > 0 && nodes[i] == nodes[i - 1])) return false;
  sort_unique(nodes);
  const auto number = [&](int node) {
    return static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
  };
  DisjointSets sets(nodes.size());
  for (const auto& [a, b] : edges) sets.join(number(a), number(b));
  for (std::size_t i = 1; i < nodes.size(); ++i)
    if (sets.root(static_cast<int>(i)) != sets.root(0)) return false;
  return true;
}

std::vector<FlatRegion> flat_regions(const std::vector<Point>& nodes, const std::vector<SurfaceTriangle>& triangles) {
  return FlatRegions(nodes, triangles).find();
}

}  // namespace fsi
