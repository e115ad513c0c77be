#pragma once

#include <algorithm>
#include <array>
#include <type_traits>

#include "fem/field_gradients.hpp"
#include "math/transpose.hpp"

namespace fsi {

/// The scalar of a sum.
template <class A, class B>
using Sum = decltype(std::declval<A>() + std::declval<B>());

/// What a weak form returns at a point: the integrand of its residual is
///   source . v + flux : grad v + scalar_source q + scalar_flux . grad q
/// for a vector test function v and a scalar one q, all on the reference domain. Only stabilisation has a scalar flux;
/// elements without it ignore that part. Each part has its own scalar type: in Jacobians one that is a Pack does not
/// depend on the unknowns.
template <class Source, class Flux = Source, class Scalar = Source>
struct Integrand {
  Vec3<Source> source;
  Mat3<Flux> flux;
  Scalar scalar_source;
  Vec3<Flux> scalar_flux;
};

/// Residual rows of one pack, [node][component], the scalar test function's row last (zero at nodes without scalars),
/// with as many derivatives as the integrand carries.
template <class Element, class T>
struct ElementRows {
  static constexpr int rows = MixedLayout<Element::components>::entries;
  T at[Element::nodes][rows];

  void set_zero() {
    for (int a = 0; a < Element::nodes; ++a)
      for (int r = 0; r < rows; ++r) at[a][r] = T(0.0);
  }

  /// Adds the integrand's terms with test gradients.
  void add_fluxes(const Integrand<T>& f, const QuadraturePoint<Element>& g, Pack weight) {
    for (int a = 0; a < Element::nodes; ++a) {
      const Vec3<Pack> weighted = weight * g.vectors().gradient[a];
      for (int k = 0; k < Element::components; ++k) {
        const int i = Element::axis[k];
        at[a][k] += f.flux(i, 0) * weighted[0] + f.flux(i, 1) * weighted[1] + f.flux(i, 2) * weighted[2];
      }
    }
    add_hoop_flux(f, g, weight);
    if constexpr (Element::stabilised)
      for (int a = 0; a < Element::scalar_nodes; ++a) {
        const Vec3<Pack> weighted = weight * g.scalars().gradient[a];
        at[a][rows - 1] +=
            f.scalar_flux[0] * weighted[0] + f.scalar_flux[1] * weighted[1] + f.scalar_flux[2] * weighted[2];
      }
  }

  /// The hoop terms of add_fluxes().
  void add_hoop_flux(const Integrand<T>& f, const QuadraturePoint<Element>& g, Pack weight) {
    if constexpr (Element::axisymmetric)
      for (int a = 0; a < Element::nodes; ++a) at[a][0] += f.flux(1, 1) * (weight * g.vectors().hoop[a]);
  }

  /// Adds the integrand's terms with test values.
  void add_sources(const Integrand<T>& f, const QuadraturePoint<Element>& g) {
    for (int a = 0; a < Element::nodes; ++a) {
      const Pack weighted = g.weight * Pack(g.vectors().value[a]);
      for (int k = 0; k < Element::components; ++k) at[a][k] += f.source[Element::axis[k]] * weighted;
    }
    for (int a = 0; a < Element::scalar_nodes; ++a)
      at[a][rows - 1] += f.scalar_source * (g.weight * Pack(g.scalars().value[a]));
  }
};

/// Integrates one pack: prepare(point geometry) evaluates what depends on gradients alone, once where gradients are
/// constant; integrand(prepared, point geometry, point) returns the Integrand.
template <class Element, class T, class Prepare, class Evaluate>
inline void integrate(ElementRows<Element, T>& rows, const typename Element::Geometry& geometry, Prepare prepare,
                      Evaluate integrand) {
  rows.set_zero();
  if constexpr (Element::constant_gradients) {
    const auto first = Element::at(geometry, 0);
    const auto prepared = prepare(first);
    Integrand<T> total = integrand(prepared, first, 0);
    rows.add_sources(total, first);
    for (int q = 1; q < Element::points; ++q) {
      const auto g = Element::at(geometry, q);
      const Integrand<T> f = integrand(prepared, g, q);
      rows.add_sources(f, g);
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) total.flux(i, j) += f.flux(i, j);
        total.scalar_flux[i] += f.scalar_flux[i];
      }
    }
    rows.add_fluxes(total, first, first.weight);  // the points of these elements weigh the same
  } else if constexpr (Element::order == 2 && std::is_same_v<T, Pack>) {
    FluxSums<Element> fluxes;
    for (int q = 0; q < Element::points; ++q) {
      const auto g = Element::at(geometry, q);
      const Integrand<T> f = integrand(prepare(g), g, q);
      rows.add_sources(f, g);
      fluxes.add(f.flux, g, g.weight);
      rows.add_hoop_flux(f, g, g.weight);
    }
    fluxes.add_to(rows.at);
  } else {
    for (int q = 0; q < Element::points; ++q) {
      const auto g = Element::at(geometry, q);
      const Integrand<T> f = integrand(prepare(g), g, q);
      rows.add_sources(f, g);
      rows.add_fluxes(f, g, g.weight);
    }
  }
}

/// Adds a pack's residual to the global one, in the mixed layout: the rows of this thread's nodes.
template <class Element, class T>
inline void scatter_residual(const ElementRows<Element, T>& rows,
                             const typename ElementPacks<Element>::ElementPack& pack, double* residual) {
  constexpr int n = ElementRows<Element, T>::rows;
  for (int a = 0; a < Element::nodes; ++a)
    for (int lane = 0; lane < pack_width; ++lane)
      if (pack.position[a * Element::nodes + a][lane] >= 0) {
        double* to = residual + MixedLayout<Element::components>::vector(pack.node[a][lane]);
        for (int r = 0; r < n; ++r) to[r] += value_of(rows.at[a][r])[lane];
      }
}

/// Adds each lane's numbers, `Count` of them, row-major, to a block of a matrix.
/// \param position  of each lane's block; negative: none
/// \param number    number(i) returns the i-th number of all lanes
template <int Count, class Number>
inline void add_to_blocks(const std::array<int, pack_width>& position, Number number, double* blocks) {
  for (int begin = 0; begin < Count; begin += pack_width) {
    const int count = std::min(pack_width, Count - begin);
    Pack x[pack_width];  // once transposed, neighbouring numbers of one block each
    for (int i = 0; i < pack_width; ++i) x[i] = i < count ? number(begin + i) : Pack(0.0);
    transpose(x);
    for (int lane = 0; lane < pack_width; ++lane)
      if (position[lane] >= 0) {
        double* to = blocks + static_cast<std::size_t>(position[lane]) * Count + begin;
        if (count == pack_width)
          (Pack::load(to) + x[lane]).store(to);
        else
          for (int i = 0; i < count; ++i) to[i] += x[lane][i];
      }
  }
}

/// Adds the derivatives with respect to node b's seeds First ... First + Columns - 1 to blocks (a, b) of a matrix whose
/// blocks have the rows of the mixed layout and `Columns` columns.
template <class Element, int Seeds, int First, int Columns>
inline void scatter_blocks(const ElementRows<Element, Dual<Seeds>>& rows,
                           const typename ElementPacks<Element>::ElementPack& pack, int b, double* blocks) {
  constexpr int n = ElementRows<Element, Dual<Seeds>>::rows;
  for (int a = 0; a < Element::nodes; ++a)
    add_to_blocks<n * Columns>(
        pack.position[a * Element::nodes + b],
        [&](int i) { return rows.at[a][i / Columns].slope[First + i % Columns]; }, blocks);
}

}  // namespace fsi
