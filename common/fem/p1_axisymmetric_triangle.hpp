#pragma once

#include <cmath>

#include "fem/point_geometry.hpp"

namespace fsi {

/// The linear triangle of a body of revolution about the z axis: coordinates (r, 0, z), components (radial, axial), the
/// circumferential strain u_r / r in the (1, 1) entry of gradients and 2 pi r in the integration weight.
struct P1AxisymmetricTriangle {
  static constexpr int dim = 2;
  static constexpr int order = 1;
  static constexpr int nodes = 3;
  static constexpr int scalar_nodes = 3;
  static constexpr int points = 3;
  static constexpr int components = 2;
  static constexpr int axis[2] = {0, 2};
  static constexpr bool constant_gradients = false;  // the hoop term varies with r
  static constexpr bool axisymmetric = true;
  static constexpr double two_pi = 6.283185307179586476925286766559;

  struct Geometry {
    Pack measure;                ///< area in the (r, z) plane, mm^2
    Pack radius[nodes];          ///< mm
    Vec3<Pack> gradient[nodes];  ///< 1/mm
    Sym3<Pack> metric;           ///< xi on the regular triangle of unit edge; nothing in the hoop direction
    Pack size_squared;           ///< h^2, h the edge of the regular triangle of the same area, mm^2
  };

  static Geometry geometry(const Vec3<Pack> x[nodes]) {
    const Pack r1 = x[1][0] - x[0][0], z1 = x[1][2] - x[0][2];
    const Pack r2 = x[2][0] - x[0][0], z2 = x[2][2] - x[0][2];
    const Pack two_areas = r1 * z2 - r2 * z1;
    const Pack inverse = Pack(1.0) / two_areas;
    Geometry g;
    g.measure = 0.5 * two_areas;
    g.gradient[1] = {{z2 * inverse, Pack(0.0), -(r2 * inverse)}};
    g.gradient[2] = {{-(z1 * inverse), Pack(0.0), r1 * inverse}};
    for (int i = 0; i < 3; ++i) g.gradient[0][i] = -(g.gradient[1][i] + g.gradient[2][i]);
    for (int a = 0; a < nodes; ++a) g.radius[a] = x[a][0];
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) {
        g.metric(i, j) = Pack(0.0);
        for (int a = 0; a < nodes; ++a) g.metric(i, j) += 0.5 * g.gradient[a][i] * g.gradient[a][j];
      }
    g.size_squared = g.measure * Pack(4.0 / std::sqrt(3.0));
    return g;
  }

  static double shape(int point, int node) { return point == node ? 2.0 / 3.0 : 1.0 / 6.0; }

  static PointGeometry<nodes, scalar_nodes> at(const Geometry& g, int point) {
    PointGeometry<nodes, scalar_nodes> p;
    Pack r(0.0);
    for (int a = 0; a < nodes; ++a) r += shape(point, a) * g.radius[a];
    p.weight = g.measure * Pack(two_pi / 3.0) * r;
    for (int a = 0; a < nodes; ++a) {
      p.of_all.value[a] = shape(point, a);
      p.of_all.gradient[a] = g.gradient[a];
      p.of_all.hoop[a] = shape(point, a) / r;
    }
    return p;
  }

  /// The element's sides: rings.
  struct Facet {
    static constexpr int nodes = 2;
    static constexpr int scalar_nodes = 2;
    static constexpr int points = 2;
    static double shape(int point, int node) { return point == node ? 0.78867513459481288225 : 0.21132486540518711775; }
    static double scalar_shape(int point, int node) { return shape(point, node); }
    /// The right-hand side of the direction from node 0 to node 1 in the (r, z) plane, times 2 pi r and the weight,
    /// mm^2: outward for a side run through counter-clockwise about its cell, z upwards and r to the right.
    template <class T>
    static Vec3<T> weighted_normal(const Vec3<T> x[nodes], int point) {
      const T r = Pack(shape(point, 0)) * x[0][0] + Pack(shape(point, 1)) * x[1][0];
      const T scale = Pack(0.5 * two_pi) * r;
      return {{scale * (x[1][2] - x[0][2]), T(0.0), scale * (x[0][0] - x[1][0])}};
    }

    /// Gauss's rule of three points, exact for cubics times r.
    static constexpr int cubic_points = 3;
    static double cubic_shape(int point, int node) {
      constexpr double offset = 0.38729833462074168852;  // sqrt(0.15)
      return 0.5 + (node == 0 ? -1 : 1) * (point - 1) * offset;
    }
    template <class T>
    static Vec3<T> cubic_weighted_normal(const Vec3<T> x[nodes], int point) {
      const T r = Pack(cubic_shape(point, 0)) * x[0][0] + Pack(cubic_shape(point, 1)) * x[1][0];
      const T scale = Pack((point == 1 ? 8.0 : 5.0) / 18.0 * two_pi) * r;
      return {{scale * (x[1][2] - x[0][2]), T(0.0), scale * (x[0][0] - x[1][0])}};
    }
  };
};

}  // namespace fsi
