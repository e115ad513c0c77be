#pragma once

#include <algorithm>
#include <cmath>

#include "mesh/point_math.hpp"

namespace fsi {

/// Distance from x to the segment from p to q, two different points, mm.
inline double distance_to_segment(const Point& x, const Point& p, const Point& q) {
  const Point along = q - p;
  const double t = std::clamp(dot(x - p, along) / dot(along, along), 0.0, 1.0);
  return distance(x, p + t * along);
}

/// Distance from x to the triangle abc in mm (C. Ericson, Real-Time Collision Detection, section 5.1.5). NaN if it is
/// flat.
inline double distance_to_triangle(const Point& x, const Point& a, const Point& b, const Point& c) {
  const Point normal = cross(b - a, c - a);
  const bool above = dot(cross(b - a, x - a), normal) >= 0 && dot(cross(c - b, x - b), normal) >= 0 &&
                     dot(cross(a - c, x - c), normal) >= 0;
  if (above) return std::abs(dot(x - a, normal)) / norm(normal);
  return std::min({distance_to_segment(x, a, b), distance_to_segment(x, b, c), distance_to_segment(x, c, a)});
}

}  // namespace fsi
