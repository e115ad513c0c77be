#pragma once

#include <array>

#include "mesh/mid_edge_nodes.hpp"
#include "fem/point_geometry.hpp"

namespace fsi {

/// The Taylor-Hood tetrahedron: quadratic vector fields on its ten nodes, linear scalar fields on its four vertices,
/// isoparametric edges. The rule of 14 points is exact for polynomials of degree five on straight edges, convection
/// (u . grad u) . v among them, and has positive weights.
struct P2P1Tetrahedron {
  static constexpr int dim = 3;
  static constexpr int order = 2;
  static constexpr int nodes = 10;
  static constexpr int scalar_nodes = 4;
  static constexpr int points = 14;
  static constexpr int components = 3;
  static constexpr int axis[3] = {0, 1, 2};
  static constexpr bool constant_gradients = false;
  static constexpr bool axisymmetric = false;

  struct Geometry {
    Vec3<Pack> x[nodes];  ///< reference coordinates of the nodes, mm
  };
  static Geometry geometry(const Vec3<Pack> x[nodes]) {
    Geometry g;
    for (int a = 0; a < nodes; ++a) g.x[a] = x[a];
    return g;
  }

  using Barycentric = std::array<double, 4>;
  /// The rule's points, in barycentric coordinates, and weights, which add up to one.
  static Barycentric point(int q) {
    constexpr double outer = 0.092735250310891226402, inner = 0.31088591926330060980, edge = 0.045503704125649649492;
    Barycentric l;
    if (q < 8) {
      const double a = q < 4 ? inner : outer;
      l.fill(a);
      l[q % 4] = 1 - 3 * a;
    } else {
      const auto& [first, second] = SimplexEdges<3>::vertices[q - 8];
      l.fill(edge);
      l[first] = l[second] = 0.5 - edge;
    }
    return l;
  }
  static double rule_weight(int q) {
    return q < 4 ? 0.11268792571801585080 : q < 8 ? 0.073493043116361949544 : 0.042546020777081466438;
  }

  /// N_a of the quadratic shape functions: l (2 l - 1) at vertices, 4 l l' in the middles.
  static double shape(const Barycentric& l, int a) {
    if (a < 4) return l[a] * (2 * l[a] - 1);
    const auto& [first, second] = SimplexEdges<3>::vertices[a - 4];
    return 4 * l[first] * l[second];
  }
  /// dN_a / dl_i, the barycentric coordinates taken as independent.
  static double slope(const Barycentric& l, int a, int i) {
    if (a < 4) return a == i ? 4 * l[a] - 1 : 0;
    const auto& [first, second] = SimplexEdges<3>::vertices[a - 4];
    return i == first ? 4 * l[second] : i == second ? 4 * l[first] : 0;
  }

  static PointGeometry<nodes, scalar_nodes> at(const Geometry& g, int q) {
    const Barycentric l = point(q);
    // Columns of dx/dl_i - dx/dl_0, i = 1, 2, 3.
    Vec3<Pack> edge[3];
    for (auto& e : edge) e = {{Pack(0.0), Pack(0.0), Pack(0.0)}};
    for (int a = 0; a < nodes; ++a) {
      const double first = slope(l, a, 0);
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) edge[i][k] += Pack(slope(l, a, i + 1) - first) * g.x[a][k];
    }
    const Vec3<Pack> c1 = cross(edge[1], edge[2]), c2 = cross(edge[2], edge[0]), c3 = cross(edge[0], edge[1]);
    const Pack six_volumes = dot(edge[0], c1);
    const Pack inverse = Pack(1.0) / six_volumes;
    Vec3<Pack> grad_l[4];
    grad_l[1] = inverse * c1;
    grad_l[2] = inverse * c2;
    grad_l[3] = inverse * c3;
    for (int k = 0; k < 3; ++k) grad_l[0][k] = -(grad_l[1][k] + grad_l[2][k] + grad_l[3][k]);

    PointGeometry<nodes, scalar_nodes> p;
    p.weight = Pack(rule_weight(q) / 6.0) * six_volumes;
    for (int a = 0; a < nodes; ++a) {
      p.of_vectors.value[a] = shape(l, a);
      p.of_vectors.gradient[a] = {{Pack(0.0), Pack(0.0), Pack(0.0)}};
      for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 3; ++k) p.of_vectors.gradient[a][k] += Pack(slope(l, a, i)) * grad_l[i][k];
    }
    for (int a = 0; a < scalar_nodes; ++a) {
      p.of_scalars.value[a] = l[a];
      p.of_scalars.gradient[a] = grad_l[a];
    }
    return p;
  }

  /// The element's faces: quadratic triangles, with the rule of seven points exact for degree five.
  struct Facet {
    static constexpr int nodes = 6;
    static constexpr int scalar_nodes = 3;
    static constexpr int points = 7;
    static constexpr int cubic_points = points;

    static std::array<double, 3> barycentric(int q) {
      if (q == 0) return {1.0 / 3, 1.0 / 3, 1.0 / 3};
      constexpr double a = 0.10128650732345633880, b = 0.47014206410511508977;
      std::array<double, 3> l;
      l.fill(q < 4 ? a : b);
      l[(q - 1) % 3] = 1 - 2 * (q < 4 ? a : b);
      return l;
    }
    static double rule_weight(int q) {
      return q == 0 ? 0.225 : q < 4 ? 0.12593918054482715260 : 0.13239415278850618074;
    }
    static double shape(int q, int a) {
      const auto l = barycentric(q);
      if (a < 3) return l[a] * (2 * l[a] - 1);
      const auto& [first, second] = SimplexEdges<2>::vertices[a - 3];
      return 4 * l[first] * l[second];
    }
    static double scalar_shape(int q, int a) { return barycentric(q)[a]; }
    static double cubic_shape(int q, int a) { return shape(q, a); }

    /// Normal times integration weight at a point, mm^2, from the node positions x (reference or current).
    template <class T>
    static Vec3<T> weighted_normal(const Vec3<T> x[nodes], int q) {
      const auto l = barycentric(q);
      const auto slope = [&](int a, int i) {
        if (a < 3) return a == i ? 4 * l[a] - 1 : 0.0;
        const auto& [first, second] = SimplexEdges<2>::vertices[a - 3];
        return i == first ? 4 * l[second] : i == second ? 4 * l[first] : 0.0;
      };
      Vec3<T> edge[2];
      for (auto& e : edge) e = {{T(0.0), T(0.0), T(0.0)}};
      for (int a = 0; a < nodes; ++a)
        for (int i = 0; i < 2; ++i)
          for (int k = 0; k < 3; ++k) edge[i][k] += Pack(slope(a, i + 1) - slope(a, 0)) * x[a][k];
      return Pack(0.5 * rule_weight(q)) * cross(edge[0], edge[1]);
    }
    template <class T>
    static Vec3<T> cubic_weighted_normal(const Vec3<T> x[nodes], int q) {
      return weighted_normal(x, q);
    }
  };
};

}  // namespace fsi
