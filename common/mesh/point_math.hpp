#pragma once

#include <array>
#include <cmath>

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

/// Signed volume of the tetrahedron abcd in mm^3; positive when bcd runs counter-clockwise seen from outside.
inline double tetrahedron_volume(const Point& a, const Point& b, const Point& c, const Point& d) {
  return dot(cross(b - a, c - a), d - a) / 6.0;
}

/// Area-weighted normal of the triangle abc in mm^2 (its length is the area), by the right-hand rule.
inline Point triangle_area_vector(const Point& a, const Point& b, const Point& c) {
  return 0.5 * cross(b - a, c - a);
}

}  // namespace fsi
