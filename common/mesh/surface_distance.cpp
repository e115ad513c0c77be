#include "mesh/surface_distance.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "mesh/point_math.hpp"

namespace fsi {

namespace {

/// Weights of a triangle's corners at the point of it that is nearest to x, by the region of corners, edges and face
/// that x lies above (C. Ericson, Real-Time Collision Detection, section 5.1.5).
std::array<double, 3> nearest_weights(const Point& x, const Point& a, const Point& b, const Point& c) {
  const Point ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
  const double a_ab = dot(ab, ax), a_ac = dot(ac, ax);
  if (a_ab <= 0 && a_ac <= 0) return {1, 0, 0};
  const double b_ab = dot(ab, bx), b_ac = dot(ac, bx);
  if (b_ab >= 0 && b_ac <= b_ab) return {0, 1, 0};
  const double of_c = a_ab * b_ac - b_ab * a_ac;
  if (of_c <= 0 && a_ab >= 0 && b_ab <= 0) {
    const double t = a_ab / (a_ab - b_ab);
    return {1 - t, t, 0};
  }
  const double c_ab = dot(ab, cx), c_ac = dot(ac, cx);
  if (c_ac >= 0 && c_ab <= c_ac) return {0, 0, 1};
  const double of_b = c_ab * a_ac - a_ab * c_ac;
  if (of_b <= 0 && a_ac >= 0 && c_ac <= 0) {
    const double t = a_ac / (a_ac - c_ac);
    return {1 - t, 0, t};
  }
  const double of_a = b_ab * c_ac - c_ab * b_ac;
  if (of_a <= 0 && b_ac - b_ab >= 0 && c_ab - c_ac >= 0) {
    const double t = (b_ac - b_ab) / ((b_ac - b_ab) + (c_ab - c_ac));
    return {0, 1 - t, t};
  }
  const double whole = of_a + of_b + of_c;
  return {of_a / whole, of_b / whole, of_c / whole};
}

/// The same of an edge, which is the triangle (a, b, b).
std::array<double, 3> nearest_weights(const Point& x, const Point& a, const Point& b) {
  const double t = std::clamp(dot(x - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
  return {1 - t, t, 0};
}

double squared_distance(const Point& x, const Point& low, const Point& high) {
  double squared = 0;
  for (int d = 0; d < 3; ++d) {
    const double out = std::max({low[d] - x[d], x[d] - high[d], 0.0});
    squared += out * out;
  }
  return squared;
}

}  // namespace

SurfaceDistance::SurfaceDistance(std::vector<Point> nodes, std::vector<Facet> facets)
    : nodes_(std::move(nodes)), facets_(std::move(facets)), order_(facets_.size()) {
  assert(!facets_.empty());
  std::iota(order_.begin(), order_.end(), 0);
  boxes_.reserve(facets_.size());
  add_box(0, static_cast<int>(facets_.size()));
}

int SurfaceDistance::add_box(int first, int last) {
  constexpr int few = 4;  // facets of a box that is not parted
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}, first, last};
  for (int i = first; i < last; ++i)
    for (const int node : facets_[order_[i]])
      for (int d = 0; d < 3; ++d) {
        box.low[d] = std::min(box.low[d], nodes_[node][d]);
        box.high[d] = std::max(box.high[d], nodes_[node][d]);
      }
  const int number = static_cast<int>(boxes_.size());
  boxes_.push_back(box);
  if (last - first <= few) return number;
  const Point size = box.high - box.low;
  const auto along = std::max_element(size.begin(), size.end()) - size.begin();
  const auto middle_of = [&](int facet) {
    const auto& [a, b, c] = facets_[facet];
    return nodes_[a][along] + nodes_[b][along] + nodes_[c][along];
  };
  const int middle = (first + last) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](int f, int g) { return std::pair(middle_of(f), f) < std::pair(middle_of(g), g); });
  const int left = add_box(first, middle), right = add_box(middle, last);
  boxes_[number].left = left;
  boxes_[number].right = right;
  return number;
}

NearestPoint SurfaceDistance::on_facet(const Point& x, int facet) const {
  const auto& [a, b, c] = facets_[facet];
  NearestPoint found;
  found.facet = facet;
  found.weights =
      b == c ? nearest_weights(x, nodes_[a], nodes_[b]) : nearest_weights(x, nodes_[a], nodes_[b], nodes_[c]);
  found.at = found.weights[0] * nodes_[a] + found.weights[1] * nodes_[b] + found.weights[2] * nodes_[c];
  found.distance = distance(x, found.at);
  return found;
}

NearestPoint SurfaceDistance::nearest(const Point& x, int guess) const {
  NearestPoint best;
  if (guess >= 0) best = on_facet(x, guess);
  std::array<std::pair<double, int>, 64> open;  // squared distance, box; halving leaves at most one more a level
  std::size_t count = 0;
  open[count++] = {0.0, 0};
  while (count > 0) {
    const auto [squared, number] = open[--count];
    if (squared >= best.distance * best.distance) continue;
    const Box& box = boxes_[number];
    if (box.left < 0) {
      for (int i = box.first; i < box.last; ++i)
        if (const auto found = on_facet(x, order_[i]); found.distance < best.distance) best = found;
      continue;
    }
    std::pair<double, int> near{squared_distance(x, boxes_[box.left].low, boxes_[box.left].high), box.left};
    std::pair<double, int> far{squared_distance(x, boxes_[box.right].low, boxes_[box.right].high), box.right};
    if (far.first < near.first) std::swap(near, far);
    open[count++] = far;
    open[count++] = near;
  }
  return best;
}

}  // namespace fsi
