#pragma once

#include <cmath>

#include "fem/point_geometry.hpp"
#include "fem/simplex_rule.hpp"
#include "fem/triangle_bodies.hpp"

namespace fsi {

/// The linear triangle, equal order for vectors and scalars. Its rule integrates mass and convection exactly: degree 2
/// in the plane and, with the factor r, degree 3 in bodies of revolution, where the hoop terms are rational.
/// \tparam Body  PlaneStrain or BodyOfRevolution
template <class Body>
struct P1Triangle {
  static constexpr int dim = 2;
  static constexpr int order = 1;
  static constexpr int nodes = 3;
  static constexpr int scalar_nodes = 3;
  static constexpr int components = 2;
  static constexpr int axis[2] = {Body::axis[0], Body::axis[1]};
  static constexpr bool axisymmetric = Body::axisymmetric;
  static constexpr bool constant_gradients = !axisymmetric;  // the hoop term varies with r
  static constexpr bool stabilised = true;

 private:
  static constexpr auto make_rule() {
    if constexpr (axisymmetric) {
      return triangle_rule_4();
    } else {
      return triangle_rule_2();
    }
  }

 public:
  static constexpr auto rule = make_rule();
  static constexpr int points = decltype(rule)::points;

  struct Geometry {
    Pack measure;                ///< area of the triangle, mm^2
    Pack radius[nodes];          ///< first coordinate, mm
    Vec3<Pack> gradient[nodes];  ///< 1/mm
    Sym3<Pack> metric;           ///< as P1Tetrahedron's, xi on the regular triangle; zero in the third direction
    Pack size_squared;           ///< h^2, h the edge of the regular triangle of the same area, mm^2
  };

  static Geometry geometry(const Vec3<Pack> x[nodes]) {
    constexpr int first = axis[0], second = axis[1], third = 3 - first - second;
    const Pack r1 = x[1][first] - x[0][first], z1 = x[1][second] - x[0][second];
    const Pack r2 = x[2][first] - x[0][first], z2 = x[2][second] - x[0][second];
    const Pack two_areas = r1 * z2 - r2 * z1;
    const Pack inverse = Pack(1.0) / two_areas;
    Geometry g;
    g.measure = 0.5 * two_areas;
    const auto set = [&](int a, Pack along_first, Pack along_second) {
      g.gradient[a][first] = along_first;
      g.gradient[a][second] = along_second;
      g.gradient[a][third] = Pack(0.0);
    };
    set(1, z2 * inverse, -(r2 * inverse));
    set(2, -(z1 * inverse), r1 * inverse);
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

  static double shape(int point, int node) { return rule.point[point][node]; }

  static PointGeometry<nodes, scalar_nodes> at(const Geometry& g, int point) {
    PointGeometry<nodes, scalar_nodes> p;
    for (int a = 0; a < nodes; ++a) {
      p.of_all.value[a] = shape(point, a);
      p.of_all.gradient[a] = g.gradient[a];
    }
    p.weight = g.measure * Pack(rule.weight[point]);
    if constexpr (axisymmetric) {
      Pack r(0.0);
      for (int a = 0; a < nodes; ++a) r += shape(point, a) * g.radius[a];
      p.weight *= Pack(two_pi) * r;
      for (int a = 0; a < nodes; ++a) p.of_all.hoop[a] = shape(point, a) / r;
    }
    return p;
  }

  /// The element's sides: strips of unit width, or rings.
  struct Facet {
    static constexpr int nodes = 2;
    static constexpr int scalar_nodes = 2;
    static constexpr auto rule = line_rule_3();
    static constexpr int points = decltype(rule)::points;
    static double shape(int point, int node) { return rule.point[point][node]; }
    static double scalar_shape(int point, int node) { return shape(point, node); }
    /// Normal to the right of the direction from node 0 to node 1, with the first axis to the right and the second one
    /// upwards, times the weight (and 2 pi r), mm^2: outward for a side that runs counter-clockwise about its cell.
    template <class T>
    static Vec3<T> weighted_normal(const Vec3<T> x[nodes], int point) {
      return normal(x, rule, point);
    }

    /// Exact for cubics times r.
    static constexpr auto cubic_rule = line_rule_5();
    static constexpr int cubic_points = decltype(cubic_rule)::points;
    static double cubic_shape(int point, int node) { return cubic_rule.point[point][node]; }
    template <class T>
    static Vec3<T> cubic_weighted_normal(const Vec3<T> x[nodes], int point) {
      return normal(x, cubic_rule, point);
    }

   private:
    template <class T, class Rule>
    static Vec3<T> normal(const Vec3<T> x[nodes], const Rule& with, int point) {
      T scale(with.weight[point]);
      if constexpr (axisymmetric)
        scale = Pack(with.weight[point] * two_pi) *
                (Pack(with.point[point][0]) * x[0][0] + Pack(with.point[point][1]) * x[1][0]);
      Vec3<T> n{{T(0.0), T(0.0), T(0.0)}};
      n[axis[0]] = scale * (x[1][axis[1]] - x[0][axis[1]]);
      n[axis[1]] = scale * (x[0][axis[0]] - x[1][axis[0]]);
      return n;
    }
  };
};

using P1PlaneTriangle = P1Triangle<PlaneStrain>;
using P1AxisymmetricTriangle = P1Triangle<BodyOfRevolution>;

}  // namespace fsi
