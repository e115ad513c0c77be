#include "fields/region_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/point_distance.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

RegionDistance::RegionDistance(const RegionShape& shape, double reach) : shape_(shape), reach_(reach + shape.within) {
  if (shape_.kind == RegionShape::Kind::surface) sort_triangles();
}

void RegionDistance::sort_triangles() {
  const auto& [nodes, triangles] = *shape_.surface;
  Point high;
  low_.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const Point& x : nodes)
    for (int d = 0; d < 3; ++d) {
      low_[d] = std::min(low_[d], x[d] - reach_);
      high[d] = std::max(high[d], x[d] + reach_);
    }
  double widest = 0;
  for (int d = 0; d < 3; ++d) widest = std::max(widest, high[d] - low_[d]);
  constexpr double most_boxes = 64;
  step_ = std::max(widest / most_boxes, std::numeric_limits<double>::min());
  for (int d = 0; d < 3; ++d) boxes_[d] = static_cast<int>((high[d] - low_[d]) / step_) + 1;
  triangles_.resize(static_cast<std::size_t>(boxes_[0]) * boxes_[1] * boxes_[2]);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    std::array<int, 3> from{}, to{};
    for (int d = 0; d < 3; ++d) {
      const auto [least, most] =
          std::minmax({nodes[triangles[t][0]][d], nodes[triangles[t][1]][d], nodes[triangles[t][2]][d]});
      const auto box = [&](double x) { return std::clamp(static_cast<int>((x - low_[d]) / step_), 0, boxes_[d] - 1); };
      from[d] = box(least - reach_);
      to[d] = box(most + reach_);
    }
    for (int i = from[0]; i <= to[0]; ++i)
      for (int j = from[1]; j <= to[1]; ++j)
        for (int k = from[2]; k <= to[2]; ++k)
          triangles_[(static_cast<std::size_t>(i) * boxes_[1] + j) * boxes_[2] + k].push_back(static_cast<int>(t));
  }
}

double RegionDistance::to_surface(const Point& x) const {
  std::array<int, 3> box;
  for (int d = 0; d < 3; ++d) {
    const double along = (x[d] - low_[d]) / step_;
    if (!(along >= 0 && along <= boxes_[d])) return reach_;
    box[d] = std::min(static_cast<int>(along), boxes_[d] - 1);
  }
  const auto& [nodes, triangles] = *shape_.surface;
  double nearest = reach_;
  for (const int t : triangles_[(static_cast<std::size_t>(box[0]) * boxes_[1] + box[1]) * boxes_[2] + box[2]]) {
    const auto& [a, b, c] = triangles[static_cast<std::size_t>(t)];
    const double away = distance_to_triangle(x, nodes[a], nodes[b], nodes[c]);
    if (away < nearest) nearest = away;  // NaN of a triangle without area is not
  }
  return nearest;
}

double RegionDistance::to_line(const Point& x) const {
  const auto& line = *shape_.line;
  double nearest = std::numeric_limits<double>::infinity(), at = 0, before = 0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Point along = line[i] - line[i - 1];
    const double length = norm(along);
    if (length == 0) continue;
    const double t = std::clamp(dot(x - line[i - 1], along) / (length * length), 0.0, 1.0);
    const double away = distance(x, line[i - 1] + t * along);
    if (away < nearest) {
      nearest = away;
      at = before + t * length;
    }
    before += length;
  }
  double outside = nearest - shape_.within;
  if (shape_.from > 0) outside = std::max(outside, shape_.from - at);
  if (shape_.to > 0) outside = std::max(outside, at - shape_.to);
  return outside;
}

double RegionDistance::operator()(const Point& x) const {
  if (shape_.kind == RegionShape::Kind::sphere) return distance(x, shape_.centre) - shape_.radius;
  if (shape_.kind == RegionShape::Kind::line) return to_line(x);
  if (shape_.kind == RegionShape::Kind::surface) return to_surface(x) - shape_.within;
  double inside = -std::numeric_limits<double>::infinity(), outside = 0;
  for (int d = 0; d < 3; ++d) {
    const double beyond = std::max(shape_.low[d] - x[d], x[d] - shape_.high[d]);
    inside = std::max(inside, beyond);
    outside += std::pow(std::max(beyond, 0.0), 2);
  }
  return outside > 0 ? std::sqrt(outside) : inside;
}

}  // namespace fsi
