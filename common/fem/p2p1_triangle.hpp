#pragma once

#include "fem/p1_triangle.hpp"
#include "fem/point_geometry.hpp"
#include "fem/quadratic_simplex.hpp"
#include "fem/simplex_rule.hpp"
#include "fem/triangle_bodies.hpp"

namespace fsi {

/// The Taylor-Hood triangle: quadratic vector fields on its six nodes, linear scalar fields on its three vertices,
/// isoparametric edges. Its rule integrates mass and convection exactly where edges are straight: degree 5 in the plane
/// and, with the factor r, degree 6 in bodies of revolution, where the hoop terms are rational.
/// \tparam Body  PlaneStrain or BodyOfRevolution
template <class Body>
struct P2P1Triangle {
  using Shapes = QuadraticSimplex<2>;
  using OnVertices = P1Triangle<Body>;
  static constexpr int dim = 2;
  static constexpr int order = 2;
  static constexpr int nodes = Shapes::nodes;
  static constexpr int scalar_nodes = Shapes::vertices;
  static constexpr int components = 2;
  static constexpr int axis[2] = {Body::axis[0], Body::axis[1]};
  static constexpr bool axisymmetric = Body::axisymmetric;
  static constexpr bool constant_gradients = false;
  static constexpr bool stabilised = false;

 private:
  static constexpr auto make_rule() {
    if constexpr (axisymmetric) {
      return triangle_rule_6();
    } else {
      return triangle_rule_5();
    }
  }

 public:
  static constexpr auto rule = make_rule();
  static constexpr int points = decltype(rule)::points;

  struct Geometry {
    static constexpr Unstabilised metric{}, size_squared{};
    Vec3<Pack> x[nodes];              ///< reference coordinates of the nodes, mm
    bool straight;                    ///< all elements of the pack are: then what follows holds at all points
    Pack two_areas;                   ///< mm^2
    Vec3<Pack> grad_l[scalar_nodes];  ///< of barycentric coordinates, 1/mm
  };
  static Geometry geometry(const Vec3<Pack> x[nodes]) {
    Geometry g;
    for (int a = 0; a < nodes; ++a) g.x[a] = x[a];
    g.straight = Shapes::is_straight(x);
    g.two_areas = barycentric_gradients(x[1] - x[0], x[2] - x[0], g.grad_l);
    return g;
  }

  static PointGeometry<nodes, scalar_nodes> at(const Geometry& g, int q) {
    const auto& l = rule.point[q];
    if (g.straight) return at(g, q, g.two_areas, g.grad_l);
    const Vec3<Pack> t0 = Shapes::tangent(g.x, l, 0);
    Vec3<Pack> grad_l[scalar_nodes];
    const Pack two_areas =
        barycentric_gradients(Shapes::tangent(g.x, l, 1) - t0, Shapes::tangent(g.x, l, 2) - t0, grad_l);
    return at(g, q, two_areas, grad_l);
  }

  /// The element's sides: quadratic strips of unit width, or rings. The rule is exact for the load of a linear pressure
  /// and, on straight sides, for |u|^2 u . n.
  struct Facet {
    using Shapes = QuadraticSimplex<1>;
    static constexpr int nodes = Shapes::nodes;
    static constexpr int scalar_nodes = Shapes::vertices;
    static constexpr auto rule = line_rule_7();
    static constexpr int points = decltype(rule)::points;
    static constexpr int cubic_points = points;

    static double shape(int q, int a) { return Shapes::shape(rule.point[q], a); }
    static double scalar_shape(int q, int a) { return rule.point[q][a]; }
    static double cubic_shape(int q, int a) { return shape(q, a); }

    /// Normal to the right of the direction from node 0 to node 1, as P1Triangle::Facet has it, mm^2.
    template <class T>
    static Vec3<T> weighted_normal(const Vec3<T> x[nodes], int q) {
      const auto& l = rule.point[q];
      const Vec3<T> along = Shapes::tangent(x, l, 1) - Shapes::tangent(x, l, 0);
      T scale(rule.weight[q]);
      if constexpr (axisymmetric) {
        T r(0.0);
        for (int a = 0; a < nodes; ++a) r += Pack(shape(q, a)) * x[a][0];
        scale = Pack(rule.weight[q] * two_pi) * r;
      }
      Vec3<T> n{{T(0.0), T(0.0), T(0.0)}};
      n[axis[0]] = scale * along[axis[1]];
      n[axis[1]] = -(scale * along[axis[0]]);
      return n;
    }
    template <class T>
    static Vec3<T> cubic_weighted_normal(const Vec3<T> x[nodes], int q) {
      return weighted_normal(x, q);
    }
  };

 private:
  /// Gradients of the barycentric coordinates, along which the position moves by e1, e2. \returns twice the area
  static Pack barycentric_gradients(const Vec3<Pack>& e1, const Vec3<Pack>& e2, Vec3<Pack> grad_l[scalar_nodes]) {
    constexpr int first = axis[0], second = axis[1], third = 3 - first - second;
    const Pack two_areas = e1[first] * e2[second] - e2[first] * e1[second];
    const Pack inverse = Pack(1.0) / two_areas;
    grad_l[1][first] = e2[second] * inverse;
    grad_l[1][second] = -(e2[first] * inverse);
    grad_l[2][first] = -(e1[second] * inverse);
    grad_l[2][second] = e1[first] * inverse;
    grad_l[1][third] = grad_l[2][third] = Pack(0.0);
    for (int k = 0; k < 3; ++k) grad_l[0][k] = -(grad_l[1][k] + grad_l[2][k]);
    return two_areas;
  }

  static PointGeometry<nodes, scalar_nodes> at(const Geometry& g, int q, Pack two_areas,
                                               const Vec3<Pack> grad_l[scalar_nodes]) {
    const auto& l = rule.point[q];
    PointGeometry<nodes, scalar_nodes> p;
    p.weight = Pack(0.5 * rule.weight[q]) * two_areas;
    for (int a = 0; a < nodes; ++a) p.of_vectors.value[a] = Shapes::shape(l, a);
    Shapes::gradients(l, grad_l, p.of_vectors.gradient);
    for (int a = 0; a < scalar_nodes; ++a) {
      p.of_scalars.value[a] = l[a];
      p.of_scalars.gradient[a] = grad_l[a];
    }
    if constexpr (axisymmetric) {
      Pack r(0.0);
      for (int a = 0; a < nodes; ++a) r += p.of_vectors.value[a] * g.x[a][0];
      p.weight *= Pack(two_pi) * r;
      const Pack inverse_r = Pack(1.0) / r;
      for (int a = 0; a < nodes; ++a) p.of_vectors.hoop[a] = p.of_vectors.value[a] * inverse_r;
    }
    return p;
  }
};

using P2P1PlaneTriangle = P2P1Triangle<PlaneStrain>;
using P2P1AxisymmetricTriangle = P2P1Triangle<BodyOfRevolution>;

}  // namespace fsi
