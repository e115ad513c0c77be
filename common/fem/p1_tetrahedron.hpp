#pragma once

#include <cmath>

#include "fem/point_geometry.hpp"

namespace fsi {

/// The linear tetrahedron, equal order for vectors and scalars, with the four-point rule exact for quadratics: mass and
/// convection are integrated exactly.
struct P1Tetrahedron {
  static constexpr int dim = 3;
  static constexpr int order = 1;         ///< of the vector fields and of the edges
  static constexpr int nodes = 4;         ///< nodes of vector fields
  static constexpr int scalar_nodes = 4;  ///< the first of them carry scalar fields
  static constexpr int points = 4;
  static constexpr int components = 3;       ///< of a vector field
  static constexpr int axis[3] = {0, 1, 2};  ///< the space axis of each component
  static constexpr bool constant_gradients = true;
  static constexpr bool axisymmetric = false;
  static constexpr bool stabilised = true;

  /// Constant data of one pack of elements, computed once from the reference coordinates.
  struct Geometry {
    Pack measure;                ///< volume, mm^3
    Vec3<Pack> gradient[nodes];  ///< grad N_a, 1/mm
    Sym3<Pack> metric;           ///< (dxi/dX)^T (dxi/dX), xi on the regular tetrahedron of unit edge, 1/mm^2
    Pack size_squared;           ///< h^2, h the edge of the regular tetrahedron of the same volume, mm^2
  };

  /// \param x  reference coordinates of the nodes, mm
  static Geometry geometry(const Vec3<Pack> x[nodes]) {
    const Vec3<Pack> e1 = x[1] - x[0], e2 = x[2] - x[0], e3 = x[3] - x[0];
    const Vec3<Pack> c1 = cross(e2, e3), c2 = cross(e3, e1), c3 = cross(e1, e2);
    const Pack six_volumes = dot(e1, c1);
    const Pack inverse = Pack(1.0) / six_volumes;
    Geometry g;
    g.measure = six_volumes * Pack(1.0 / 6.0);
    g.gradient[1] = inverse * c1;
    g.gradient[2] = inverse * c2;
    g.gradient[3] = inverse * c3;
    for (int i = 0; i < 3; ++i) g.gradient[0][i] = -(g.gradient[1][i] + g.gradient[2][i] + g.gradient[3][i]);
    // Regular tetrahedron: xi = sum_a N_a xi_a with |xi_a - xi_b| = 1, so that
    //   (dxi/dX)^T (dxi/dX) = sum_ab grad N_a (xi_a . xi_b) grad N_b^T = 1/2 sum_a grad N_a grad N_a^T,
    // as sum_a grad N_a = 0.
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) {
        g.metric(i, j) = Pack(0.0);
        for (int a = 0; a < nodes; ++a) g.metric(i, j) += 0.5 * g.gradient[a][i] * g.gradient[a][j];
      }
    const Pack h = cbrt(g.measure * Pack(6.0 * std::sqrt(2.0)));
    g.size_squared = h * h;
    return g;
  }

  static constexpr double near = 0.58541019662496845446, far = 0.13819660112501051518;
  static double shape(int point, int node) { return point == node ? near : far; }

  static PointGeometry<nodes, scalar_nodes> at(const Geometry& g, int point) {
    PointGeometry<nodes, scalar_nodes> p;
    p.weight = g.measure * Pack(0.25);
    for (int a = 0; a < nodes; ++a) {
      p.of_all.value[a] = shape(point, a);
      p.of_all.gradient[a] = g.gradient[a];
    }
    return p;
  }

  /// The element's faces: linear triangles.
  struct Facet {
    static constexpr int nodes = 3;
    static constexpr int scalar_nodes = 3;
    static constexpr int points = 3;
    static double shape(int point, int node) { return point == node ? 2.0 / 3.0 : 1.0 / 6.0; }
    static double scalar_shape(int point, int node) { return shape(point, node); }
    /// Normal times integration weight at a point, mm^2, from the node positions x (reference or current).
    template <class T>
    static Vec3<T> weighted_normal(const Vec3<T> x[nodes], int /*point*/) {
      return Pack(1.0 / 6.0) * cross(x[1] - x[0], x[2] - x[0]);
    }

    /// A rule exact for cubics such as |u|^2 u . n: the centre, with a negative weight, and three points.
    static constexpr int cubic_points = 4;
    static double cubic_shape(int point, int node) { return point == 0 ? 1.0 / 3.0 : (point - 1 == node ? 0.6 : 0.2); }
    template <class T>
    static Vec3<T> cubic_weighted_normal(const Vec3<T> x[nodes], int point) {
      return Pack((point == 0 ? -27.0 : 25.0) / 96.0) * cross(x[1] - x[0], x[2] - x[0]);
    }
  };
};

}  // namespace fsi
