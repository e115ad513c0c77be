#pragma once

#include "fem/contributions.hpp"
#include "fem/quadratic_simplex.hpp"

namespace fsi {

/// Derivatives by way of the quadrature points, for Taylor-Hood elements: a weak form is differentiated at a point with
/// respect to the fields' values and gradients there. Derivatives with respect to nodal unknowns follow by the chain
/// rule, since the fields at a point are linear in those. Differentiating for one node after the other (`seed_gradient`
/// and `seed_value` with a node) gives the same numbers up to rounding; with ten nodes it takes several times as long.
///
/// Gradients of trial and test functions are taken along the element's barycentric coordinates l_0, l_1, ...:
///   grad N_a = sum over m of dN_a/dl_m grad l_m.
/// One or two of the dN_a/dl_m are not zero, and they are linear in l (QuadraticSimplex). So the factor T(m, m')
/// between two gradients is not summed over the points for each pair of nodes. Its moments with the few l_i l_j are,
/// and all pairs follow from these:
///   sum over q of dN_a/dl_m T dN_b/dl_m' = combination of the  sum over q of l_i l_j T.
/// The l add up to one, so that derivatives along l_0 are minus the sum of the others, which alone are evaluated.
///
/// There is no stabilisation: nothing depends on gradients of scalars, and there is no scalar flux. Sources do not
/// depend on scalars, and fluxes depend on vectors' values by hoop terms alone; the types of an Integrand's parts
/// enforce that.

/// 1/r at a point of an axisymmetric element: the shape functions add up to one.
template <class Element>
inline Pack inverse_radius(const QuadraturePoint<Element>& g) {
  Pack sum(0.0);
  for (int a = 0; a < Element::nodes; ++a) sum += g.vectors().hoop[a];
  return sum;
}

/// Seeds for one component of a vector field's gradient: its derivatives along l_1, l_2, ..., then its value, which
/// the gradient sees in a hoop term.
template <class Element>
inline constexpr int gradient_seeds = Element::dim + (Element::axisymmetric ? 1 : 0);
template <class Element>
inline auto seed_gradient_of(int k, const Mat3<Pack>& h, const QuadraturePoint<Element>& g) {
  Mat3<Dual<gradient_seeds<Element>>> s;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) s(i, j) = h(i, j);
  for (int m = 1; m <= Element::dim; ++m)
    for (int j = 0; j < Element::dim; ++j)
      s(Element::axis[k], Element::axis[j]).slope[m - 1] = g.scalars().gradient[m][Element::axis[j]];
  if constexpr (Element::axisymmetric)
    if (k == 0) s(1, 1).slope[Element::dim] = inverse_radius<Element>(g);
  return s;
}
/// Seeds for the components of a vector field's value, and for a scalar's.
/// \param factor  derivative of the quantity with respect to the field's value, e.g. 1 / dt for a rate
template <class Element>
inline auto seed_components(const Vec3<Pack>& v, double factor = 1.0) {
  Vec3<Dual<Element::components>> s;
  for (int i = 0; i < 3; ++i) s[i] = v[i];
  for (int k = 0; k < Element::components; ++k) s[Element::axis[k]].slope[k] = factor;
  return s;
}
inline Dual<1> seed_scalar(Pack v) {
  Dual<1> s(v);
  s.slope[0] = 1.0;
  return s;
}

/// The shape functions of an element at the points of its rule, for sums over these.
template <class Element>
struct PointTable {
  using Shapes = typename Element::Shapes;
  static constexpr int points = Element::points, vertices = Shapes::vertices;
  static constexpr int products = vertices * (vertices + 1) / 2;

  double value[points][Element::nodes];     ///< N_a
  double barycentric[points][vertices];     ///< l_i
  double product[points][products];         ///< l_i l_j, i <= j
  int product_of[vertices][vertices];       ///< place of l_i l_j in `product`
  int along[Element::nodes][2];             ///< the m of the dN_a / dl_m that are not zero; twice the same at vertices
  double slope[Element::nodes][2][points];  ///< dN_a / dl_m for these m

  constexpr PointTable() : value{}, barycentric{}, product{}, product_of{}, along{}, slope{} {
    for (int a = 0; a < Element::nodes; ++a)
      for (int e = 0; e < 2; ++e)
        along[a][e] = a < vertices ? a : SimplexEdges<Element::dim>::vertices[a - vertices][e];
    int next = 0;
    for (int i = 0; i < vertices; ++i)
      for (int j = i; j < vertices; ++j) product_of[i][j] = product_of[j][i] = next++;
    for (int q = 0; q < points; ++q) {
      const auto& l = Element::rule.point[q];
      for (int a = 0; a < Element::nodes; ++a) {
        value[q][a] = Shapes::shape(l, a);
        for (int e = 0; e < 2; ++e) slope[a][e][q] = Shapes::slope(l, a, along[a][e]);
      }
      for (int i = 0; i < vertices; ++i) {
        barycentric[q][i] = l[i];
        for (int j = i; j < vertices; ++j) product[q][product_of[i][j]] = l[i] * l[j];
      }
    }
  }
};
template <class Element>
inline constexpr PointTable<Element> point_table{};

/// Rows whose test functions are linear in l: derivatives of a vector test function's components along l_1, l_2, ...,
/// and the scalar test function's value.
template <class Element>
struct LinearRows {
  static constexpr int scalar = Element::components * Element::dim;
  static constexpr int count = scalar + 1;
  static constexpr int along(int k, int m) { return k * Element::dim + m - 1; }
};

/// Calls put(row, factor of the row's test function in the integrand times the point's weight) for the linear rows.
template <class Element, class Source, class T, class Scalar, class Put>
inline void for_each_linear_row(const Integrand<Source, T, Scalar>& f, const QuadraturePoint<Element>& g, Put put) {
  using Rows = LinearRows<Element>;
  for (int m = 1; m <= Element::dim; ++m) {
    const Vec3<Pack> along = g.weight * g.scalars().gradient[m];
    for (int k = 0; k < Element::components; ++k) {
      const int i = Element::axis[k];
      T sum = along[Element::axis[0]] * f.flux(i, Element::axis[0]);
      for (int j = 1; j < Element::dim; ++j) sum += along[Element::axis[j]] * f.flux(i, Element::axis[j]);
      put(Rows::along(k, m), sum);
    }
  }
  put(Rows::scalar, g.weight * f.scalar_source);
}
/// The hoop term's factor of the first component's test value, times the point's weight.
template <class Element, class T>
inline T hoop_flux(const Mat3<T>& flux, const QuadraturePoint<Element>& g) {
  return (g.weight * inverse_radius<Element>(g)) * flux(1, 1);
}

/// An integrand without its derivatives.
template <class Source, class Flux, class Scalar>
inline Integrand<Pack> value_of(const Integrand<Source, Flux, Scalar>& f) {
  Integrand<Pack> v;
  for (int i = 0; i < 3; ++i) {
    v.source[i] = value_of(f.source[i]);
    for (int j = 0; j < 3; ++j) v.flux(i, j) = value_of(f.flux(i, j));
  }
  v.scalar_source = value_of(f.scalar_source);
  return v;
}

/// An integrand's derivatives with respect to a vector field at all points, and their moments.
template <class Element>
struct VectorTangent {
  static constexpr int n = Element::components, dim = Element::dim, points = Element::points;
  using Rows = LinearRows<Element>;
  using Table = PointTable<Element>;
  using Gradient = Dual<gradient_seeds<Element>>;

  /// Of the rows of test values: [row][component of the field][by its value, by its derivatives along l_0, l_1, ...]
  /// [point].
  Pack of_values[n][n][dim + 2][points];
  /// Of the linear rows: [row][component][by derivatives along l_1, l_2, ...][point] and, where there are hoop terms,
  /// by the value of the first component.
  Pack of_linear[Rows::count][n][dim][points];
  Pack of_linear_by_value[Element::axisymmetric ? Rows::count : 1][points];
  /// Sums over the points: [row][component][by derivatives along l_0, l_1, ...][times l_i l_j].
  Pack moment[Rows::count][n][dim + 1][Table::products];

  /// \param f  seeded by seed_gradient_of(k, ...)
  template <class Source>
  void set_gradient(int k, const Integrand<Source, Gradient, Gradient>& f, const QuadraturePoint<Element>& g, int q) {
    for (int i = 0; i < n; ++i) {
      Gradient x = g.weight * Gradient(f.source[Element::axis[i]]);
      if constexpr (Element::axisymmetric) {
        if (i == 0) x += hoop_flux<Element>(f.flux, g);
        of_values[i][k][0][q] = x.slope[dim];
      }
      Pack others(0.0);
      for (int m = 1; m <= dim; ++m) {
        of_values[i][k][1 + m][q] = x.slope[m - 1];
        others += x.slope[m - 1];
      }
      of_values[i][k][1][q] = -others;
    }
    for_each_linear_row<Element>(f, g, [&](int row, const Gradient& x) {
      for (int m = 1; m <= dim; ++m) of_linear[row][k][m - 1][q] = x.slope[m - 1];
      if constexpr (Element::axisymmetric)
        if (k == 0) of_linear_by_value[row][q] = x.slope[dim];
    });
  }
  /// Call after set_gradient() at this point for all components.
  /// \param source  an integrand's, seeded by seed_components()
  void add_values(const Vec3<Dual<n>>& source, const QuadraturePoint<Element>& g, int q) {
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) {
        const Pack x = g.weight * source[Element::axis[i]].slope[k];
        Pack& to = of_values[i][k][0][q];
        if constexpr (Element::axisymmetric)
          to += x;
        else
          to = x;
      }
  }
  /// Makes the moments, once all points are set.
  void sum() {
    for (int row = 0; row < Rows::count; ++row)
      for (int k = 0; k < n; ++k) {
        for (int m = 0; m < dim; ++m) sum_products(of_linear[row][k][m], moment[row][k][1 + m]);
        for (int p = 0; p < Table::products; ++p) {
          Pack others = moment[row][k][1][p];
          for (int m = 2; m <= dim; ++m) others += moment[row][k][m][p];
          moment[row][k][0][p] = -others;
        }
      }
  }
  static void sum_products(const Pack (&at)[points], Pack (&to)[Table::products]) {
    Pack sum[Table::products];
    for (int p = 0; p < Table::products; ++p) sum[p] = Pack(point_table<Element>.product[0][p]) * at[0];
    for (int q = 1; q < points; ++q)
      for (int p = 0; p < Table::products; ++p) sum[p] += Pack(point_table<Element>.product[q][p]) * at[q];
    for (int p = 0; p < Table::products; ++p) to[p] = sum[p];
  }
};
/// The same with respect to a scalar field.
template <class Element>
struct ScalarTangent {
  using Rows = LinearRows<Element>;
  static constexpr int points = Element::points;

  Pack of_value[points];  ///< row of the first component's test value: by hoop terms
  Pack of_linear[Rows::count][points];
  Pack moment[Rows::count][PointTable<Element>::products];

  /// \param f  seeded by seed_scalar()
  template <class Source, class Scalar>
  void set(const Integrand<Source, Dual<1>, Scalar>& f, const QuadraturePoint<Element>& g, int q) {
    if constexpr (Element::axisymmetric) of_value[q] = hoop_flux<Element>(f.flux, g).slope[0];
    for_each_linear_row<Element>(f, g, [&](int row, const auto& x) { of_linear[row][q] = Dual<1>(x).slope[0]; });
  }
  void sum() {
    for (int row = 0; row < Rows::count; ++row) VectorTangent<Element>::sum_products(of_linear[row], moment[row]);
  }
};

/// Derivatives of the rows of all nodes with respect to unknowns of one node: [node][row][unknown].
template <class Element, int Columns>
struct NodeColumns {
  static constexpr int rows = MixedLayout<Element::components>::entries;
  Pack at[Element::nodes][rows][Columns];
};

namespace detail {

/// One column of the rows of all nodes.
/// \param of_values  of component k at the points
/// \param of_linear  of a linear row the sums over the points times l_i
template <class Element, int Columns, class OfValues>
inline void set_column(NodeColumns<Element, Columns>& to, int column, OfValues of_values,
                       Pack (&of_linear)[LinearRows<Element>::count][PointTable<Element>::vertices]) {
  using Rows = LinearRows<Element>;
  constexpr int vertices = PointTable<Element>::vertices;
  constexpr const auto& table = point_table<Element>;
  for (int k = 0; k < Element::components; ++k) {
    Pack sum[Element::nodes];
    of_values(k, sum);
    Pack along[vertices][vertices];  // [m][i]
    for (int i = 0; i < vertices; ++i) {
      along[0][i] = Pack(0.0);
      for (int m = 1; m < vertices; ++m) {
        along[m][i] = of_linear[Rows::along(k, m)][i];
        along[0][i] -= along[m][i];
      }
    }
    for (int a = 0; a < vertices; ++a) {  // dN_a/dl_a = 4 l_a - (l_0 + l_1 + ...)
      Pack all = along[a][0];
      for (int i = 1; i < vertices; ++i) all += along[a][i];
      to.at[a][k][column] = sum[a] + (4.0 * along[a][a] - all);
    }
    for (int a = vertices; a < Element::nodes; ++a) {  // dN_a/dl_m = 4 l_i
      const int m = table.along[a][0], i = table.along[a][1];
      to.at[a][k][column] = sum[a] + 4.0 * (along[m][i] + along[i][m]);
    }
  }
  for (int a = 0; a < Element::nodes; ++a)
    to.at[a][Element::components][column] = a < vertices ? of_linear[Rows::scalar][a] : Pack(0.0);
}

/// Sums over the points of N_a times what at(q) returns.
template <class Element, class At>
inline void sum_values(Pack (&sum)[Element::nodes], At at) {
  for (int a = 0; a < Element::nodes; ++a) sum[a] = Pack(0.0);
  for (int q = 0; q < Element::points; ++q) {
    const Pack x = at(q);
    for (int a = 0; a < Element::nodes; ++a) sum[a] += Pack(point_table<Element>.value[q][a]) * x;
  }
}

}  // namespace detail

/// The derivatives with respect to node b's vector, in columns First, First + 1, ...
template <int First, class Element, int Columns>
inline void set_vector_columns(NodeColumns<Element, Columns>& to, const VectorTangent<Element>& tangent, int b) {
  using Rows = LinearRows<Element>;
  constexpr int vertices = PointTable<Element>::vertices;
  constexpr const auto& table = point_table<Element>;
  const int first = table.along[b][0], second = table.along[b][1];
  const double *s = table.slope[b][0], *t = table.slope[b][1];
  for (int k = 0; k < Element::components; ++k) {
    Pack linear[Rows::count][vertices];  // sums times l_i, of the moments by node b's slopes as in set_column()
    for (int row = 0; row < Rows::count; ++row) {
      const auto& moment = tangent.moment[row][k];
      for (int i = 0; i < vertices; ++i) {
        const auto& with = table.product_of[i];
        if (b < vertices) {
          Pack all = moment[b][with[0]];
          for (int j = 1; j < vertices; ++j) all += moment[b][with[j]];
          linear[row][i] = 4.0 * moment[b][with[b]] - all;
        } else {
          linear[row][i] = 4.0 * (moment[first][with[second]] + moment[second][with[first]]);
        }
      }
    }
    if constexpr (Element::axisymmetric)
      if (k == 0)
        for (int row = 0; row < Rows::count; ++row)
          for (int q = 0; q < Element::points; ++q)
            for (int i = 0; i < vertices; ++i)
              linear[row][i] += Pack(table.value[q][b] * table.barycentric[q][i]) * tangent.of_linear_by_value[row][q];
    detail::set_column(
        to, First + k,
        [&](int i, Pack(&sum)[Element::nodes]) {
          const auto& at = tangent.of_values[i][k];
          if (b < vertices)
            detail::sum_values<Element>(
                sum, [&](int q) { return Pack(table.value[q][b]) * at[0][q] + Pack(s[q]) * at[1 + first][q]; });
          else
            detail::sum_values<Element>(sum, [&](int q) {
              return Pack(table.value[q][b]) * at[0][q] + Pack(s[q]) * at[1 + first][q] +
                     Pack(t[q]) * at[1 + second][q];
            });
        },
        linear);
  }
}

/// The same with respect to node b's scalar.
template <int Column, class Element, int Columns>
inline void set_scalar_column(NodeColumns<Element, Columns>& to, const ScalarTangent<Element>& tangent, int b) {
  using Rows = LinearRows<Element>;
  constexpr const auto& table = point_table<Element>;
  if (b >= Element::scalar_nodes) {
    for (auto& rows : to.at)
      for (auto& row : rows) row[Column] = Pack(0.0);
    return;
  }
  Pack linear[Rows::count][Element::scalar_nodes];
  for (int row = 0; row < Rows::count; ++row)
    for (int i = 0; i < Element::scalar_nodes; ++i) linear[row][i] = tangent.moment[row][table.product_of[i][b]];
  detail::set_column(
      to, Column,
      [&](int i, Pack(&sum)[Element::nodes]) {
        if (Element::axisymmetric && i == 0)
          detail::sum_values<Element>(sum, [&](int q) { return Pack(table.barycentric[q][b]) * tangent.of_value[q]; });
        else
          for (auto& x : sum) x = Pack(0.0);
      },
      linear);
}

/// Adds columns First ... First + Count - 1 to blocks (a, b) of a matrix whose blocks have the rows of the mixed layout
/// and `Count` columns.
template <int First, int Count, class Element, int Columns>
inline void scatter_columns(const NodeColumns<Element, Columns>& from,
                            const typename ElementPacks<Element>::ElementPack& pack, int b, double* blocks) {
  for (int a = 0; a < Element::nodes; ++a)
    add_to_blocks<NodeColumns<Element, Columns>::rows * Count>(
        pack.position[a * Element::nodes + b], [&](int i) { return from.at[a][i / Count][First + i % Count]; }, blocks);
}

}  // namespace fsi
