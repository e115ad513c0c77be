#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/mid_edge_nodes.hpp"
#include "mesh/point_math.hpp"
#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// The map from barycentric coordinates to places in a straight or quadratic cell, by its shape functions, and back.
/// Triangles lie in the plane of their mesh.
template <int Dim, int Order>
struct CellMap {
  static constexpr int nodes = nodes_of_simplex(Dim, Order);
  using Barycentric = std::array<double, Dim + 1>;

  std::array<Point, nodes> x;  ///< mm

  /// Values of the shape functions: l, or l (2 l - 1) at vertices and 4 l l' in the middles.
  static std::array<double, nodes> shape(const Barycentric& l) {
    if constexpr (Order == 1) {
      return l;
    } else {
      std::array<double, nodes> value;
      for (int i = 0; i <= Dim; ++i) value[i] = l[i] * (2 * l[i] - 1);
      for (std::size_t e = 0; e < SimplexEdges<Dim>::vertices.size(); ++e) {
        const auto& [a, b] = SimplexEdges<Dim>::vertices[e];
        value[Dim + 1 + e] = 4 * l[a] * l[b];
      }
      return value;
    }
  }

  Point at(const Barycentric& l) const {
    const auto weight = shape(l);
    Point sum{0, 0, 0};
    for (int i = 0; i < nodes; ++i) sum = sum + weight[i] * x[i];
    return sum;
  }

  /// dx/dl_i, the coordinates taken as independent, mm.
  std::array<Point, Dim + 1> slopes(const Barycentric& l) const {
    std::array<Point, Dim + 1> slope;
    if constexpr (Order == 1) {
      for (int i = 0; i <= Dim; ++i) slope[i] = x[i];
    } else {
      for (int i = 0; i <= Dim; ++i) slope[i] = (4 * l[i] - 1) * x[i];
      for (std::size_t e = 0; e < SimplexEdges<Dim>::vertices.size(); ++e) {
        const auto& [a, b] = SimplexEdges<Dim>::vertices[e];
        slope[a] = slope[a] + 4 * l[b] * x[Dim + 1 + e];
        slope[b] = slope[b] + 4 * l[a] * x[Dim + 1 + e];
      }
    }
    return slope;
  }

  /// Coordinates of a place in the straight cell of the vertices.
  Barycentric straight(const Point& p) const {
    if constexpr (Dim == 3) {
      const double volume = tetrahedron_volume(x[0], x[1], x[2], x[3]);
      const double wb = tetrahedron_volume(x[0], p, x[2], x[3]) / volume,
                   wp = tetrahedron_volume(x[0], x[1], p, x[3]) / volume,
                   wq = tetrahedron_volume(x[0], x[1], x[2], p) / volume;
      return {1 - wb - wp - wq, wb, wp, wq};
    } else {
      const double area = triangle_area(x[0], x[1], x[2]);
      const double wb = triangle_area(x[0], p, x[2]) / area, wc = triangle_area(x[0], x[1], p) / area;
      return {1 - wb - wc, wb, wc};
    }
  }

  /// Coordinates of a place, by Newton's method from those in the straight cell.
  /// \return whether they were found; a place well outside may have none
  bool find(const Point& p, Barycentric& l) const {
    l = straight(p);
    if constexpr (Order == 1) return true;
    constexpr int most_steps = 30;
    constexpr double converged = 1e-13, astray = 10;
    for (int step = 0; step < most_steps; ++step) {
      const Barycentric change = newton_step(p, l);
      double largest = 0;
      for (int i = 0; i <= Dim; ++i) {
        l[i] += change[i];
        largest = std::max(largest, std::abs(change[i]));
        if (!(std::abs(l[i]) < astray)) return false;
      }
      if (largest < converged) return true;
    }
    return false;
  }

 private:
  Barycentric newton_step(const Point& p, const Barycentric& l) const {
    const auto slope = slopes(l);  // columns of the Jacobian are differences to the first
    std::array<Point, Dim> column;
    for (int i = 0; i < Dim; ++i) column[i] = slope[i + 1] - slope[0];
    const Point off = p - at(l);
    Barycentric change{};
    if constexpr (Dim == 3) {
      const double det = dot(column[0], cross(column[1], column[2]));
      for (int i = 0; i < 3; ++i) change[i + 1] = dot(off, cross(column[(i + 1) % 3], column[(i + 2) % 3])) / det;
    } else {
      const double det = planar_cross(column[0], column[1]);
      change[1] = planar_cross(off, column[1]) / det;
      change[2] = planar_cross(column[0], off) / det;
    }
    for (int i = 1; i <= Dim; ++i) change[0] -= change[i];
    return change;
  }
};

}  // namespace fsi
