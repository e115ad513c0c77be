#pragma once

#include "fem/contributions.hpp"

namespace fsi {

/// Derivatives by way of the quadrature points, for elements with many nodes: a weak form is differentiated once per
/// point, with respect to the values and gradients that the fields have there, and the derivatives with respect to
/// nodal unknowns follow by the chain rule, since the fields at a point are linear in those. Differentiating for one
/// node after the other (`seed_gradient` and `seed_value` with a node) gives the same numbers up to rounding; with ten
/// nodes it takes several times as long.
///
/// For elements without stabilisation: nothing depends on gradients of scalars, and there is no scalar flux.

/// The numbers that a vector field has at a point, and in this order the seeds for them: of each component its value
/// and its derivatives along the element's axes, then the hoop term where there is one. What a vector test function has
/// there is counted in the same way.
template <class Element>
struct PointEntries {
  static constexpr int n = Element::components;
  static constexpr int hoop = n * (1 + Element::dim);
  static constexpr int count = hoop + (Element::axisymmetric ? 1 : 0);
  static constexpr int value(int k) { return k * (1 + Element::dim); }
  static constexpr int derivative(int k, int j) { return value(k) + 1 + j; }
};

/// Attaches to the gradient of a vector field its seeds, of which the field's are First, First + 1, ...
template <class Element, int Seeds, int First>
inline Mat3<Dual<Seeds>> seed_point_gradient(const Mat3<Pack>& h) {
  using Entries = PointEntries<Element>;
  Mat3<Dual<Seeds>> s;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) s(i, j) = Dual<Seeds>(h(i, j));
  for (int k = 0; k < Element::components; ++k)
    for (int j = 0; j < Element::dim; ++j)
      s(Element::axis[k], Element::axis[j]).slope[First + Entries::derivative(k, j)] = Pack(1.0);
  if constexpr (Element::axisymmetric) s(1, 1).slope[First + Entries::hoop] = Pack(1.0);
  return s;
}
/// \param factor  derivative of the quantity with respect to the field's value, e.g. 1 / dt for a rate
template <class Element, int Seeds, int First>
inline Vec3<Dual<Seeds>> seed_point_value(const Vec3<Pack>& v, double factor = 1.0) {
  Vec3<Dual<Seeds>> s;
  for (int i = 0; i < 3; ++i) s[i] = Dual<Seeds>(v[i]);
  for (int k = 0; k < Element::components; ++k)
    s[Element::axis[k]].slope[First + PointEntries<Element>::value(k)] = Pack(factor);
  return s;
}
template <int Seeds, int At>
inline Dual<Seeds> seed_point_value(const Pack& v) {
  Dual<Seeds> s(v);
  s.slope[At] = Pack(1.0);
  return s;
}

/// An integrand without its derivatives.
template <int Seeds>
inline Integrand<Pack> value_of(const Integrand<Dual<Seeds>>& f) {
  Integrand<Pack> v;
  for (int i = 0; i < 3; ++i) {
    v.source[i] = f.source[i].value;
    for (int j = 0; j < 3; ++j) v.flux(i, j) = f.flux(i, j).value;
  }
  v.scalar_source = f.scalar_source.value;
  return v;
}

/// The derivatives of an integrand times the point's weight: rows are what it multiplies of the test functions, first
/// the entries of the vector's, then the scalar's value.
template <class Element, int Seeds>
struct PointTangent {
  using Entries = PointEntries<Element>;
  static constexpr int scalar = Entries::count;
  Pack at[Entries::count + 1][Seeds];

  void set(const Integrand<Dual<Seeds>>& f, Pack weight) {
    const auto put = [&](int row, const Dual<Seeds>& x) {
      for (int s = 0; s < Seeds; ++s) at[row][s] = weight * x.slope[s];
    };
    for (int k = 0; k < Element::components; ++k) {
      put(Entries::value(k), f.source[Element::axis[k]]);
      for (int j = 0; j < Element::dim; ++j) put(Entries::derivative(k, j), f.flux(Element::axis[k], Element::axis[j]));
    }
    if constexpr (Element::axisymmetric) put(Entries::hoop, f.flux(1, 1));
    put(scalar, f.scalar_source);
  }
};

namespace detail {

/// Adds to the rows of all nodes, in columns Column, Column + 1, ..., a point's derivatives with respect to `Count`
/// nodal unknowns. \param by  [entry of the test functions][unknown]
template <int Column, class Element, int Columns, std::size_t Entries, std::size_t Count>
inline void add_columns(ElementRows<Element, Dual<Columns>>& rows, const Pack (&by)[Entries][Count],
                        const QuadraturePoint<Element>& g) {
  using E = PointEntries<Element>;
  constexpr int count = static_cast<int>(Count);
  for (int a = 0; a < Element::nodes; ++a) {
    const Pack value(g.vectors().value[a]);
    const Vec3<Pack> gradient = g.vectors().gradient[a];
    for (int k = 0; k < Element::components; ++k)
      for (int c = 0; c < count; ++c) {
        Pack sum = value * by[E::value(k)][c];
        for (int j = 0; j < Element::dim; ++j) sum += gradient[Element::axis[j]] * by[E::derivative(k, j)][c];
        if constexpr (Element::axisymmetric)
          if (k == 0) sum += g.vectors().hoop[a] * by[E::hoop][c];
        rows.at[a][k].slope[Column + c] += sum;
      }
  }
  for (int a = 0; a < Element::scalar_nodes; ++a)
    for (int c = 0; c < count; ++c)
      rows.at[a][Element::components].slope[Column + c] += Pack(g.scalars().value[a]) * by[Entries - 1][c];
}

}  // namespace detail

/// Adds a point's derivatives with respect to node b's vector, whose entries have the tangent's seeds from First on, to
/// columns Column, Column + 1, ... of the rows.
template <int First, int Column, class Element, int Columns, int Seeds>
inline void add_vector_columns(ElementRows<Element, Dual<Columns>>& rows, const PointTangent<Element, Seeds>& tangent,
                               const QuadraturePoint<Element>& g, int b) {
  using E = PointEntries<Element>;
  const Pack value(g.vectors().value[b]);
  const Vec3<Pack> gradient = g.vectors().gradient[b];
  Pack by[E::count + 1][Element::components];
  for (int row = 0; row <= E::count; ++row)
    for (int k = 0; k < Element::components; ++k) {
      const Pack* t = tangent.at[row] + First;
      Pack sum = value * t[E::value(k)];
      for (int j = 0; j < Element::dim; ++j) sum += gradient[Element::axis[j]] * t[E::derivative(k, j)];
      if constexpr (Element::axisymmetric)
        if (k == 0) sum += g.vectors().hoop[b] * t[E::hoop];
      by[row][k] = sum;
    }
  detail::add_columns<Column>(rows, by, g);
}

/// The same with respect to node b's scalar, whose value has the tangent's seed At.
template <int At, int Column, class Element, int Columns, int Seeds>
inline void add_scalar_column(ElementRows<Element, Dual<Columns>>& rows, const PointTangent<Element, Seeds>& tangent,
                              const QuadraturePoint<Element>& g, int b) {
  using E = PointEntries<Element>;
  if (b >= Element::scalar_nodes) return;
  const Pack value(g.scalars().value[b]);
  Pack by[E::count + 1][1];
  for (int row = 0; row <= E::count; ++row) by[row][0] = value * tangent.at[row][At];
  detail::add_columns<Column>(rows, by, g);
}

}  // namespace fsi
