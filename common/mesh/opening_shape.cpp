#include "mesh/opening_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "mesh/disjoint_sets.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

constexpr double flat_within = 0.05;  // of the radius
constexpr double round_within = 1.25;

/// Edges that one triangle has alone.
template <std::size_t Nodes>
std::vector<std::pair<int, int>> rim_edges(const std::vector<std::array<int, Nodes>>& surface) {
  std::vector<std::pair<int, int>> edges, rim;
  for (const auto& f : surface)
    for (int k = 0; k < 3; ++k) edges.push_back(std::minmax(f[k], f[(k + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    for (end = begin; end < edges.size() && edges[end] == edges[begin];) ++end;
    if (end - begin == 1) rim.push_back(edges[begin]);
  }
  return rim;
}

int connected_lines(const std::vector<std::pair<int, int>>& edges) {
  std::map<int, int> number;
  for (const auto& [a, b] : edges) {
    number.try_emplace(a, static_cast<int>(number.size()));
    number.try_emplace(b, static_cast<int>(number.size()));
  }
  DisjointSets sets(number.size());
  for (const auto& [a, b] : edges) sets.join(number[a], number[b]);
  int lines = 0;
  for (std::size_t i = 0; i < number.size(); ++i) lines += sets.root(static_cast<int>(i)) == static_cast<int>(i);
  return lines;
}

}  // namespace

double OpeningShape::radius() const {
  return std::sqrt(area / std::acos(-1.0));
}

bool OpeningShape::flat() const {
  return off_plane <= flat_within * radius();
}

bool OpeningShape::round() const {
  return rims == 1 && farthest_rim <= round_within * nearest_rim;
}

template <std::size_t Nodes>
OpeningShape shape_of_opening(const std::vector<Point>& nodes, const std::vector<std::array<int, Nodes>>& surface) {
  OpeningShape shape;
  shape.triangles = surface.size();
  Point mean{0, 0, 0};
  for (const auto& f : surface) {
    const Point vector = triangle_area_vector(nodes[f[0]], nodes[f[1]], nodes[f[2]]);
    const double size = norm(vector);
    shape.area += size;
    mean = mean + vector;
    for (int k = 0; k < 3; ++k) shape.centre = shape.centre + (size / 3) * nodes[f[k]];
  }
  if (!(shape.area > 0)) return shape;
  shape.centre = (1 / shape.area) * shape.centre;
  if (norm(mean) > 0) shape.normal = (1 / norm(mean)) * mean;
  for (const auto& f : surface)
    for (int k = 0; k < 3; ++k)
      shape.off_plane = std::max(shape.off_plane, std::abs(dot(shape.normal, nodes[f[k]] - shape.centre)));
  const auto rim = rim_edges(surface);
  shape.rims = connected_lines(rim);
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Point &a = nodes[rim[i].first], &b = nodes[rim[i].second];
    const double middle = distance(0.5 * (a + b), shape.centre);
    shape.nearest_rim = i == 0 ? middle : std::min(shape.nearest_rim, middle);
    shape.farthest_rim = std::max({shape.farthest_rim, distance(a, shape.centre), distance(b, shape.centre)});
  }
  return shape;
}

std::string to_text(const OpeningShape& shape) {
  return fmt::format("{:.4g} mm^2, radius {:.4g} mm, at {}, {}, {}", shape.area, shape.radius(), place_of(shape.centre),
                     shape.flat() ? "flat" : fmt::format("vertices up to {:.3g} mm off its plane", shape.off_plane),
                     shape.round() ? "round"
                                   : fmt::format("not round: its rim is {:.3g} to {:.3g} mm from there",
                                                 shape.nearest_rim, shape.farthest_rim));
}

std::string said_of(const OpeningShape& shape) {
  std::string text;
  const auto add = [&](const std::string& more) { text += (text.empty() ? "" : "; it ") + more; };
  if (shape.triangles == 1) add("is one triangle");
  if (shape.rims > 1) add(fmt::format("has {} rims, as an annulus or several disks have", shape.rims));
  if (shape.rims == 0) add("has no rim: it closes in itself");
  if (!shape.flat()) add(fmt::format("is bent: its vertices are up to {:.3g} mm off its plane", shape.off_plane));
  return text;
}

template OpeningShape shape_of_opening(const std::vector<Point>&, const std::vector<std::array<int, 3>>&);
template OpeningShape shape_of_opening(const std::vector<Point>&, const std::vector<std::array<int, 6>>&);

}  // namespace fsi
