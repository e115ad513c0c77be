#pragma once

#include <algorithm>
#include <type_traits>
#include <vector>

#include "fem/element_packs.hpp"
#include "fem/nodal_layout.hpp"
#include "fem/point_geometry.hpp"

namespace fsi {

/// The scalar of a kernel: a pack, or a pack with Seeds derivatives.
template <int Seeds>
struct SeededScalar {
  using Type = Dual<Seeds>;
};
template <>
struct SeededScalar<0> {
  using Type = Pack;
};
template <int Seeds>
using Seeded = typename SeededScalar<Seeds>::Type;

/// An element's shape functions and weight at one quadrature point.
template <class Element>
using QuadraturePoint = PointGeometry<Element::nodes, Element::scalar_nodes>;

/// Nodal values of a vector field in one pack, [node][component].
template <class Element>
struct NodalVector {
  Pack at[Element::nodes][Element::components];
};
/// Nodal values of a scalar field in one pack.
template <class Element>
struct NodalScalar {
  Pack at[Element::scalar_nodes];
};

/// Loads one pack's nodal values from an array of a layout: its vectors or, below, its scalars.
template <class Layout, class Element>
inline void gather(NodalVector<Element>& to, const typename ElementPacks<Element>::ElementPack& pack,
                   const double* from) {
  for (int a = 0; a < Element::nodes; ++a) {
    const double* nodes[pack_width];
    for (int lane = 0; lane < pack_width; ++lane) nodes[lane] = from + Layout::vector(pack.node[a][lane]);
    for (int i = 0; i < Element::components; ++i) {
      Pack::Lanes lanes = {};  // setting one lane of a pack reads the others, which are not set yet
      for (int lane = 0; lane < pack_width; ++lane) lanes[lane] = nodes[lane][i];
      to.at[a][i] = Pack(lanes);
    }
  }
}
template <class Layout, class Element>
inline void gather(NodalScalar<Element>& to, const typename ElementPacks<Element>::ElementPack& pack,
                   const double* from) {
  for (int a = 0; a < Element::scalar_nodes; ++a) {
    Pack::Lanes lanes = {};
    for (int lane = 0; lane < pack_width; ++lane) lanes[lane] = from[Layout::scalar(pack.node[a][lane])];
    to.at[a] = Pack(lanes);
  }
}

/// Gradient of a vector field as a 3 x 3 tensor, (i, j) = d u_i / d X_j; u_r / r in (1, 1) of bodies of revolution.
template <class Element>
inline Mat3<Pack> gradient_of(const NodalVector<Element>& u, const QuadraturePoint<Element>& g) {
  Mat3<Pack> h;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) h(i, j) = Pack(0.0);
  for (int a = 0; a < Element::nodes; ++a) {
    for (int k = 0; k < Element::components; ++k)
      for (int j = 0; j < Element::components; ++j)
        h(Element::axis[k], Element::axis[j]) += u.at[a][k] * g.vectors().gradient[a][Element::axis[j]];
    if constexpr (Element::axisymmetric) h(1, 1) += u.at[a][0] * g.vectors().hoop[a];
  }
  return h;
}
template <class Element>
inline Vec3<Pack> gradient_of(const NodalScalar<Element>& p, const QuadraturePoint<Element>& g) {
  Vec3<Pack> h{{Pack(0.0), Pack(0.0), Pack(0.0)}};
  for (int a = 0; a < Element::scalar_nodes; ++a)
    for (int j = 0; j < Element::components; ++j)
      h[Element::axis[j]] += p.at[a] * g.scalars().gradient[a][Element::axis[j]];
  return h;
}
template <class Element>
inline Vec3<Pack> value_of(const NodalVector<Element>& u, const QuadraturePoint<Element>& g) {
  Vec3<Pack> v{{Pack(0.0), Pack(0.0), Pack(0.0)}};
  for (int a = 0; a < Element::nodes; ++a)
    for (int k = 0; k < Element::components; ++k) v[Element::axis[k]] += g.vectors().value[a] * u.at[a][k];
  return v;
}
template <class Element>
inline Pack value_of(const NodalScalar<Element>& p, const QuadraturePoint<Element>& g) {
  Pack v(0.0);
  for (int a = 0; a < Element::scalar_nodes; ++a) v += g.scalars().value[a] * p.at[a];
  return v;
}

/// Attaches to a quantity at a point its derivatives with respect to the unknowns of node b, which occupy the seeds
/// from First on: one per component of a vector, one of a scalar. Without seeds the quantity itself.
template <class Element, int Seeds, int First>
inline auto seed_gradient(const Mat3<Pack>& h, const QuadraturePoint<Element>& g, int b) {
  if constexpr (Seeds == 0) {
    return h;
  } else {
    Mat3<Dual<Seeds>> s;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) s(i, j) = Dual<Seeds>(h(i, j));
    for (int k = 0; k < Element::components; ++k)
      for (int j = 0; j < 3; ++j) s(Element::axis[k], j).slope[First + k] = g.vectors().gradient[b][j];
    if constexpr (Element::axisymmetric) s(1, 1).slope[First] = g.vectors().hoop[b];
    return s;
  }
}
template <class Element, int Seeds, int First>
inline auto seed_gradient(const Vec3<Pack>& h, const QuadraturePoint<Element>& g, int b) {
  if constexpr (Seeds == 0) {
    return h;
  } else {
    Vec3<Dual<Seeds>> s;
    for (int j = 0; j < 3; ++j) {
      s[j] = Dual<Seeds>(h[j]);
      if (b < Element::scalar_nodes) s[j].slope[First] = g.scalars().gradient[b][j];
    }
    return s;
  }
}
/// \param factor  derivative of the quantity with respect to the interpolated unknown, e.g. 1 / dt for a rate
template <class Element, int Seeds, int First>
inline auto seed_value(const Vec3<Pack>& v, const QuadraturePoint<Element>& g, int b, double factor = 1.0) {
  if constexpr (Seeds == 0) {
    return v;
  } else {
    Vec3<Dual<Seeds>> s;
    for (int i = 0; i < 3; ++i) s[i] = Dual<Seeds>(v[i]);
    for (int k = 0; k < Element::components; ++k)
      s[Element::axis[k]].slope[First + k] = Pack(factor * g.vectors().value[b]);
    return s;
  }
}
template <class Element, int Seeds, int First>
inline auto seed_value(const Pack& v, const QuadraturePoint<Element>& g, int b) {
  if constexpr (Seeds == 0) {
    return v;
  } else {
    Dual<Seeds> s(v);
    if (b < Element::scalar_nodes) s.slope[First] = Pack(g.scalars().value[b]);
    return s;
  }
}

}  // namespace fsi
