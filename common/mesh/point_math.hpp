#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

inline Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point operator+(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point operator*(double s, const Point& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double norm(const Point& a) {
  return std::sqrt(dot(a, a));
}
inline double distance(const Point& a, const Point& b) {
  return norm(a - b);
}

/// The box around points, along the axes.
struct BoundingBox {
  Point low, high;

  /// \param points  at least one
  explicit BoundingBox(const std::vector<Point>& points) : low(points.front()), high(low) {
    for (const Point& x : points)
      for (int d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], x[d]);
        high[d] = std::max(high[d], x[d]);
      }
  }
  Point extent() const { return high - low; }
  double size() const { return distance(low, high); }  ///< its diagonal
};

/// For messages: coordinates that are zero to rounding are zero, mm.
inline Point without_rounding(Point x) {
  for (double& c : x)
    if (std::abs(c) < 1e-9) c = 0;
  return x;
}

/// Signed volume of the tetrahedron abcd in mm^3; positive when bcd runs counter-clockwise seen from outside.
inline double tetrahedron_volume(const Point& a, const Point& b, const Point& c, const Point& d) {
  return dot(cross(b - a, c - a), d - a) / 6.0;
}

/// Area-weighted normal of the triangle abc in mm^2 (its length is the area), by the right-hand rule.
inline Point triangle_area_vector(const Point& a, const Point& b, const Point& c) {
  return 0.5 * cross(b - a, c - a);
}

/// u x v of two vectors of a triangle mesh's plane, mm^2; positive when v lies counter-clockwise of u, seen with r (or
/// x) to the right and z (or y) upwards. Such vectors are (r, 0, z) or (x, y, 0), so one of the two terms is zero.
inline double planar_cross(const Point& u, const Point& v) {
  return (u[0] * v[2] - u[2] * v[0]) + (u[0] * v[1] - u[1] * v[0]);
}

/// Signed area of the triangle abc in a triangle mesh's plane, mm^2; positive when counter-clockwise as above.
inline double triangle_area(const Point& a, const Point& b, const Point& c) {
  return 0.5 * planar_cross(b - a, c - a);
}

/// Signed volume in mm^3 of the tetrahedron of the first four points, area in mm^2 of the triangle of the first three.
template <int Dim>
double simplex_volume(const Point* x) {
  if constexpr (Dim == 3)
    return tetrahedron_volume(x[0], x[1], x[2], x[3]);
  else
    return triangle_area(x[0], x[1], x[2]);
}

}  // namespace fsi
