#pragma once

#include <algorithm>
#include <cmath>

#include "fem/simplex_rule.hpp"
#include "math/tensor.hpp"
#include "mesh/mid_edge_nodes.hpp"

namespace fsi {

/// Quadratic shape functions on a simplex in barycentric coordinates l: vertices first, then the middles of the edges
/// in the order of SimplexEdges.
template <int Dim>
struct QuadraticSimplex {
  static constexpr int vertices = Dim + 1;
  static constexpr int nodes = nodes_of_simplex(Dim, 2);

  /// N_a: l (2 l - 1) at vertices, 4 l l' in the middles.
  template <class Barycentric>
  static constexpr double shape(const Barycentric& l, int a) {
    if (a < vertices) return l[a] * (2 * l[a] - 1);
    const auto& ends = SimplexEdges<Dim>::vertices[a - vertices];
    return 4 * l[ends[0]] * l[ends[1]];
  }
  /// dN_a / dl_i, the barycentric coordinates taken as independent.
  template <class Barycentric>
  static constexpr double slope(const Barycentric& l, int a, int i) {
    if (a < vertices) return a == i ? 4 * l[a] - 1 : 0;
    const auto& ends = SimplexEdges<Dim>::vertices[a - vertices];
    return i == ends[0] ? 4 * l[ends[1]] : i == ends[1] ? 4 * l[ends[0]] : 0;
  }

  /// Whether in all lanes all edges are straight, with their nodes in the middle, up to rounding: then gradients of the
  /// barycentric coordinates are constant in each element.
  static bool is_straight(const Vec3<Pack> x[nodes]) {
    constexpr double rounding = 1e-13;
    for (int a = vertices; a < nodes; ++a) {
      const auto& ends = SimplexEdges<Dim>::vertices[a - vertices];
      for (int lane = 0; lane < pack_width; ++lane) {
        double off = 0, length = 0;
        for (int k = 0; k < 3; ++k) {
          const double from = x[ends[0]][k][lane], to = x[ends[1]][k][lane];
          off = std::max(off, std::abs(x[a][k][lane] - 0.5 * (from + to)));
          length = std::max(length, std::abs(to - from));
        }
        if (!(off <= rounding * length)) return false;
      }
    }
    return true;
  }

  /// Sum of x_a dN_a / dl_i over the nodes: how the position moves with l_i alone, mm.
  template <class T, class Barycentric>
  static Vec3<T> tangent(const Vec3<T> x[nodes], const Barycentric& l, int i) {
    Vec3<T> t;
    for (int k = 0; k < 3; ++k) t[k] = Pack(slope(l, i, i)) * x[i][k];
    for (int a = vertices; a < nodes; ++a) {
      const auto& ends = SimplexEdges<Dim>::vertices[a - vertices];
      if (ends[0] != i && ends[1] != i) continue;
      for (int k = 0; k < 3; ++k) t[k] += Pack(slope(l, a, i)) * x[a][k];
    }
    return t;
  }
  /// grad N_a of all nodes from the gradients of the barycentric coordinates.
  template <class Barycentric>
  static void gradients(const Barycentric& l, const Vec3<Pack> grad_l[vertices], Vec3<Pack> gradient[nodes]) {
    for (int a = 0; a < vertices; ++a) gradient[a] = Pack(slope(l, a, a)) * grad_l[a];
    for (int a = vertices; a < nodes; ++a) {
      const auto& ends = SimplexEdges<Dim>::vertices[a - vertices];
      for (int k = 0; k < 3; ++k)
        gradient[a][k] =
            Pack(slope(l, a, ends[0])) * grad_l[ends[0]][k] + Pack(slope(l, a, ends[1])) * grad_l[ends[1]][k];
    }
  }
};

}  // namespace fsi
