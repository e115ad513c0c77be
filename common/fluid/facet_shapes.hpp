#pragma once

#include <array>
#include <cmath>
#include <type_traits>

#include "fem/quadratic_simplex.hpp"
#include "fem/simplex_rule.hpp"
#include "fem/triangle_bodies.hpp"
#include "math/dual.hpp"
#include "math/tensor.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

/// Shape functions of an element's vector fields on its facets with their derivatives, and a rule with positive weights
/// that is exact for three of them times r on straight facets.
template <class Element>
struct FacetShapes {
  static constexpr int dim = Element::dim - 1;  ///< of the facet
  static constexpr int nodes = Element::Facet::nodes;
  using Shapes = QuadraticSimplex<dim>;

 private:
  static constexpr auto make_rule() {
    if constexpr (dim == 1)
      return line_rule_7();
    else if constexpr (Element::order == 1)
      return triangle_rule_4();
    else
      return triangle_rule_6();
  }

 public:
  static constexpr auto rule = make_rule();
  static constexpr int points = decltype(rule)::points;

  static constexpr double shape(int q, int a) {
    if constexpr (Element::order == 1)
      return rule.point[q][a];
    else
      return Shapes::shape(rule.point[q], a);
  }
  /// dN_a / dl_i, the barycentric coordinates taken as independent.
  static constexpr double slope(int q, int a, int i) {
    if constexpr (Element::order == 1)
      return a == i ? 1 : 0;
    else
      return Shapes::slope(rule.point[q], a, i);
  }

  using Positions = std::array<Point, nodes>;  ///< of a facet's nodes, mm

  /// The normal times the area that a point stands for, mm^2: of the whole ring where the body is one of revolution, of
  /// unit thickness in the plane. Its sense is that of Element::Facet::weighted_normal().
  static Point weighted_normal(const Positions& x, int q) {
    Point normal{0, 0, 0};
    if constexpr (dim == 1) {
      const Point along = tangent(x, q, 0);
      normal[Element::axis[0]] = along[Element::axis[1]];
      normal[Element::axis[1]] = -along[Element::axis[0]];
    } else {
      normal = 0.5 * cross(tangent(x, q, 0), tangent(x, q, 1));
    }
    double weight = rule.weight[q];
    if constexpr (Element::axisymmetric) {
      double r = 0;
      for (int a = 0; a < nodes; ++a) r += shape(q, a) * x[a][0];
      weight *= two_pi * r;
    }
    return weight * normal;
  }

  /// The same of positions over another scalar type.
  template <class T>
  static Vec3<T> weighted_normal_of(const Vec3<T> (&x)[nodes], int q) {
    const auto tangent_of = [&](int i) {
      Vec3<T> t{{T(0.0), T(0.0), T(0.0)}};
      for (int a = 0; a < nodes; ++a) t = t + Pack(slope(q, a, i + 1) - slope(q, a, 0)) * x[a];
      return t;
    };
    Vec3<T> normal{{T(0.0), T(0.0), T(0.0)}};
    if constexpr (dim == 1) {
      const Vec3<T> along = tangent_of(0);
      normal[Element::axis[0]] = along[Element::axis[1]];
      normal[Element::axis[1]] = -along[Element::axis[0]];
    } else {
      normal = Pack(0.5) * cross(tangent_of(0), tangent_of(1));
    }
    T weight(rule.weight[q]);
    if constexpr (Element::axisymmetric) {
      T r(0.0);
      for (int a = 0; a < nodes; ++a) r += Pack(shape(q, a)) * x[a][0];
      weight = Pack(two_pi * rule.weight[q]) * r;
    }
    return weight * normal;
  }

  /// Gradients of the shape functions within the surface, 1/mm.
  static std::array<Point, nodes> gradients(const Positions& x, int q) {
    std::array<Point, dim> dual;  // of the tangents: tangent[i] . dual[j] = (i == j)
    if constexpr (dim == 1) {
      const Point t = tangent(x, q, 0);
      dual[0] = (1 / dot(t, t)) * t;
    } else {
      const Point t0 = tangent(x, q, 0), t1 = tangent(x, q, 1), normal = cross(t0, t1);
      dual[0] = (1 / dot(normal, normal)) * cross(t1, normal);
      dual[1] = (1 / dot(normal, normal)) * cross(normal, t0);
    }
    std::array<Point, nodes> gradient;
    for (int a = 0; a < nodes; ++a) {
      gradient[a] = {0, 0, 0};
      for (int i = 0; i < dim; ++i) gradient[a] = gradient[a] + (slope(q, a, i + 1) - slope(q, a, 0)) * dual[i];
    }
    return gradient;
  }

 private:
  /// dx/dl_(i + 1) - dx/dl_0.
  static Point tangent(const Positions& x, int q, int i) {
    Point t{0, 0, 0};
    for (int a = 0; a < nodes; ++a) t = t + (slope(q, a, i + 1) - slope(q, a, 0)) * x[a];
    return t;
  }
};

}  // namespace fsi
