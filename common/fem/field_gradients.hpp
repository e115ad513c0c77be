#pragma once

#include "fem/interpolation.hpp"
#include "fem/quadratic_simplex.hpp"

namespace fsi {

/// The gradient of a vector field of one pack, at one quadrature point after the other.
template <class Element, bool is_quadratic = Element::order == 2>
class FieldGradients {
 public:
  /// \param u  must outlive this
  explicit FieldGradients(const NodalVector<Element>& u) : u_(u) {}
  Mat3<Pack> at(const QuadraturePoint<Element>& g) const { return gradient_of(u_, g); }

 private:
  const NodalVector<Element>& u_;
};

/// Derivatives of a quadratic field along the barycentric coordinates l_m, less those along l_0, which make gradients:
///   grad u = sum over m > 0 of (du/dl_m - du/dl_0) grad l_m.
/// They are linear in l, also where the element is curved. So they are found at the vertices, once an element, and a
/// point takes less than half of the products that the gradients of all shape functions would take.
template <class Element>
struct VertexSlopes {
  static constexpr int dim = Element::dim, vertices = dim + 1, components = Element::components;

  Pack at[vertices][dim][components];  ///< [vertex][m - 1]

  /// The middle node between two vertices.
  static constexpr int middle(int i, int j) {
    const auto& edges = SimplexEdges<dim>::vertices;
    for (int e = 0; e < static_cast<int>(edges.size()); ++e)
      if ((edges[e][0] == i && edges[e][1] == j) || (edges[e][0] == j && edges[e][1] == i)) return vertices + e;
    return -1;
  }
  struct Middles {
    int of[vertices][vertices];
    constexpr Middles() : of{} {
      for (int i = 0; i < vertices; ++i)
        for (int j = 0; j < vertices; ++j) of[i][j] = middle(i, j);
    }
  };
  static constexpr Middles middles{};
};

template <class Element>
class FieldGradients<Element, true> {
 public:
  using Slopes = VertexSlopes<Element>;

  /// \param u  must outlive this
  explicit FieldGradients(const NodalVector<Element>& u) : u_(u) {
    for (int v = 0; v < Slopes::vertices; ++v)
      for (int k = 0; k < Slopes::components; ++k) {
        Pack along[Slopes::vertices];  // dN_a/dl_i at vertex v: 3 of N_v along l_v; else -1 of N_i and 4 of the middle
        for (int i = 0; i < Slopes::vertices; ++i)
          along[i] = i == v ? Pack(3.0) * u.at[v][k] : Pack(4.0) * u.at[Slopes::middles.of[i][v]][k] - u.at[i][k];
        for (int m = 1; m <= Slopes::dim; ++m) slopes_.at[v][m - 1][k] = along[m] - along[0];
      }
  }

  Mat3<Pack> at(const QuadraturePoint<Element>& g) const {
    Mat3<Pack> h;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) h(i, j) = Pack(0.0);
    for (int m = 1; m <= Slopes::dim; ++m)
      for (int k = 0; k < Slopes::components; ++k) {
        Pack slope = Pack(g.scalars().value[0]) * slopes_.at[0][m - 1][k];
        for (int v = 1; v < Slopes::vertices; ++v) slope += Pack(g.scalars().value[v]) * slopes_.at[v][m - 1][k];
        for (int j = 0; j < Slopes::dim; ++j)
          h(Element::axis[k], Element::axis[j]) += slope * g.scalars().gradient[m][Element::axis[j]];
      }
    if constexpr (Element::axisymmetric)
      for (int a = 0; a < Element::nodes; ++a) h(1, 1) += u_.at[a][0] * g.vectors().hoop[a];
    return h;
  }

 private:
  const NodalVector<Element>& u_;
  Slopes slopes_;
};

template <class Element>
inline Mat3<Pack> gradient_of(const FieldGradients<Element>& u, const QuadraturePoint<Element>& g) {
  return u.at(g);
}

/// The transpose of FieldGradients: sums of flux : grad v over the points, kept as factors of the test functions'
/// derivatives along l_m at the vertices, and added to the nodes' rows once an element.
template <class Element>
class FluxSums {
 public:
  using Slopes = VertexSlopes<Element>;

  FluxSums() {
    for (auto& of_vertex : sums_.at)
      for (auto& along : of_vertex)
        for (Pack& sum : along) sum = Pack(0.0);
  }

  /// \param flux  of the point, a Mat3<Pack>; hoop terms are left out
  void add(const Mat3<Pack>& flux, const QuadraturePoint<Element>& g, Pack weight) {
    for (int m = 1; m <= Slopes::dim; ++m) {
      const Vec3<Pack> along = weight * g.scalars().gradient[m];
      for (int k = 0; k < Slopes::components; ++k) {
        const int i = Element::axis[k];
        Pack product = flux(i, Element::axis[0]) * along[Element::axis[0]];
        for (int j = 1; j < Slopes::dim; ++j) product += flux(i, Element::axis[j]) * along[Element::axis[j]];
        for (int v = 0; v < Slopes::vertices; ++v) sums_.at[v][m - 1][k] += Pack(g.scalars().value[v]) * product;
      }
    }
  }

  /// rows[node][component] += what has been summed up.
  template <class Rows>
  void add_to(Rows& rows) const {
    for (int v = 0; v < Slopes::vertices; ++v)
      for (int k = 0; k < Slopes::components; ++k) {
        Pack along[Slopes::vertices];
        along[0] = Pack(0.0);
        for (int m = 1; m <= Slopes::dim; ++m) {
          along[m] = sums_.at[v][m - 1][k];
          along[0] -= along[m];
        }
        for (int i = 0; i < Slopes::vertices; ++i) {
          if (i == v) {
            rows[v][k] += Pack(3.0) * along[v];
          } else {
            rows[i][k] -= along[i];
            rows[Slopes::middles.of[i][v]][k] += Pack(4.0) * along[i];
          }
        }
      }
  }

 private:
  Slopes sums_;
};

}  // namespace fsi
