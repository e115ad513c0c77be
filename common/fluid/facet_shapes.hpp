#pragma once

#include <array>
#include <cmath>
#include <type_traits>

#include "fem/quadratic_simplex.hpp"
#include "fem/simplex_rule.hpp"
#include "fem/triangle_bodies.hpp"
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

  /// Of one point of a facet: gradients of the shape functions within the surface, 1/mm, and the area that the point
  /// stands for, mm^2, of the whole ring where the body is one of revolution, of unit thickness in the plane.
  struct AtPoint {
    std::array<Point, nodes> gradient;
    double area;
  };
  /// \param x  positions of the facet's nodes, mm
  static AtPoint at(const std::array<Point, nodes>& x, int q) {
    std::array<Point, dim> tangent{};  // dx/dl_(i + 1) - dx/dl_0
    for (int i = 0; i < dim; ++i)
      for (int a = 0; a < nodes; ++a) tangent[i] = tangent[i] + (slope(q, a, i + 1) - slope(q, a, 0)) * x[a];
    // The dual basis: of the surface, tangent[i] . dual[j] = (i == j).
    std::array<Point, dim> dual;
    AtPoint p;
    if constexpr (dim == 1) {
      const double square = dot(tangent[0], tangent[0]);
      dual[0] = (1 / square) * tangent[0];
      p.area = rule.weight[q] * std::sqrt(square);
    } else {
      const Point normal = cross(tangent[0], tangent[1]);
      const double square = dot(normal, normal);
      dual[0] = (1 / square) * cross(tangent[1], normal);
      dual[1] = (1 / square) * cross(normal, tangent[0]);
      p.area = 0.5 * rule.weight[q] * std::sqrt(square);
    }
    if constexpr (Element::axisymmetric) {
      double r = 0;
      for (int a = 0; a < nodes; ++a) r += shape(q, a) * x[a][0];
      p.area *= two_pi * r;
    }
    for (int a = 0; a < nodes; ++a) {
      p.gradient[a] = {0, 0, 0};
      for (int i = 0; i < dim; ++i) p.gradient[a] = p.gradient[a] + (slope(q, a, i + 1) - slope(q, a, 0)) * dual[i];
    }
    return p;
  }
};

}  // namespace fsi
