#pragma once

#include "fem/p1_tetrahedron.hpp"
#include "fem/point_geometry.hpp"
#include "fem/quadratic_simplex.hpp"
#include "fem/simplex_rule.hpp"

namespace fsi {

/// The Taylor-Hood tetrahedron: quadratic vector fields on its ten nodes, linear scalar fields on its four vertices,
/// isoparametric edges. The rule of 14 points is exact for polynomials of degree five on straight edges, convection
/// (u . grad u) . v among them, and has positive weights.
struct P2P1Tetrahedron {
  using Shapes = QuadraticSimplex<3>;
  using OnVertices = P1Tetrahedron;
  static constexpr int dim = 3;
  static constexpr int order = 2;
  static constexpr int nodes = Shapes::nodes;
  static constexpr int scalar_nodes = Shapes::vertices;
  static constexpr int components = 3;
  static constexpr int axis[3] = {0, 1, 2};
  static constexpr bool constant_gradients = false;
  static constexpr bool axisymmetric = false;
  static constexpr bool stabilised = false;
  static constexpr auto rule = tetrahedron_rule_5();
  static constexpr int points = decltype(rule)::points;

  struct Geometry {
    static constexpr Unstabilised metric{}, size_squared{};
    Vec3<Pack> x[nodes];              ///< reference coordinates of the nodes, mm
    bool straight;                    ///< all elements of the pack are: then what follows holds at all points
    Pack six_volumes;                 ///< mm^3
    Vec3<Pack> grad_l[scalar_nodes];  ///< of barycentric coordinates, 1/mm
  };
  static Geometry geometry(const Vec3<Pack> x[nodes]) {
    Geometry g;
    for (int a = 0; a < nodes; ++a) g.x[a] = x[a];
    g.straight = Shapes::is_straight(x);
    g.six_volumes = barycentric_gradients(x[1] - x[0], x[2] - x[0], x[3] - x[0], g.grad_l);
    return g;
  }

  static PointGeometry<nodes, scalar_nodes> at(const Geometry& g, int q) {
    const auto& l = rule.point[q];
    if (g.straight) return at(q, g.six_volumes, g.grad_l);
    const Vec3<Pack> t0 = Shapes::tangent(g.x, l, 0);
    Vec3<Pack> grad_l[scalar_nodes];
    const Pack six_volumes = barycentric_gradients(Shapes::tangent(g.x, l, 1) - t0, Shapes::tangent(g.x, l, 2) - t0,
                                                   Shapes::tangent(g.x, l, 3) - t0, grad_l);
    return at(q, six_volumes, grad_l);
  }

  /// The element's faces: quadratic triangles. The rule is exact for loads (degree 4 on straight edges), the `cubic`
  /// one for |u|^2 u . n (degree 6).
  struct Facet {
    using Shapes = QuadraticSimplex<2>;
    static constexpr int nodes = Shapes::nodes;
    static constexpr int scalar_nodes = Shapes::vertices;
    static constexpr auto rule = triangle_rule_5();
    static constexpr auto cubic_rule = triangle_rule_6();
    static constexpr int points = decltype(rule)::points;
    static constexpr int cubic_points = decltype(cubic_rule)::points;

    static double shape(int q, int a) { return Shapes::shape(rule.point[q], a); }
    static double scalar_shape(int q, int a) { return rule.point[q][a]; }
    static double cubic_shape(int q, int a) { return Shapes::shape(cubic_rule.point[q], a); }

    /// Normal times integration weight at a point, mm^2, from the node positions x (reference or current).
    template <class T>
    static Vec3<T> weighted_normal(const Vec3<T> x[nodes], int q) {
      return normal(x, rule, q);
    }
    template <class T>
    static Vec3<T> cubic_weighted_normal(const Vec3<T> x[nodes], int q) {
      return normal(x, cubic_rule, q);
    }

   private:
    template <class T, class Rule>
    static Vec3<T> normal(const Vec3<T> x[nodes], const Rule& with, int q) {
      const auto& l = with.point[q];
      const Vec3<T> t0 = Shapes::tangent(x, l, 0);
      return Pack(0.5 * with.weight[q]) * cross(Shapes::tangent(x, l, 1) - t0, Shapes::tangent(x, l, 2) - t0);
    }
  };

 private:
  /// Gradients of the barycentric coordinates, along which the position moves by e1, e2, e3.
  /// \returns six times the volume
  static Pack barycentric_gradients(const Vec3<Pack>& e1, const Vec3<Pack>& e2, const Vec3<Pack>& e3,
                                    Vec3<Pack> grad_l[scalar_nodes]) {
    const Vec3<Pack> c1 = cross(e2, e3), c2 = cross(e3, e1), c3 = cross(e1, e2);
    const Pack six_volumes = dot(e1, c1);
    const Pack inverse = Pack(1.0) / six_volumes;
    grad_l[1] = inverse * c1;
    grad_l[2] = inverse * c2;
    grad_l[3] = inverse * c3;
    for (int k = 0; k < 3; ++k) grad_l[0][k] = -(grad_l[1][k] + grad_l[2][k] + grad_l[3][k]);
    return six_volumes;
  }

  static PointGeometry<nodes, scalar_nodes> at(int q, Pack six_volumes, const Vec3<Pack> grad_l[scalar_nodes]) {
    const auto& l = rule.point[q];
    PointGeometry<nodes, scalar_nodes> p;
    p.weight = Pack(rule.weight[q] / 6.0) * six_volumes;
    for (int a = 0; a < nodes; ++a) p.of_vectors.value[a] = Shapes::shape(l, a);
    Shapes::gradients(l, grad_l, p.of_vectors.gradient);
    for (int a = 0; a < scalar_nodes; ++a) {
      p.of_scalars.value[a] = l[a];
      p.of_scalars.gradient[a] = grad_l[a];
    }
    return p;
  }
};

}  // namespace fsi
