#pragma once

#include <cassert>
#include <vector>

#include "algebra/block_matrix.hpp"
#include "fem/nodal_layout.hpp"
#include "math/dual.hpp"
#include "math/tensor.hpp"

namespace fsi {

/// Reference positions of a facet's nodes.
template <class Facet, class Point, class Nodes>
void facet_corners(const std::vector<Point>& x, const Nodes& facet, Vec3<Pack> (&corner)[Facet::nodes]) {
  for (int a = 0; a < Facet::nodes; ++a)
    for (int i = 0; i < 3; ++i) corner[a][i] = Pack(x[facet[a]][i]);
}

/// Calls visit(q, area) for the quadrature points of a reference facet with the area of each, mm^2.
template <class F, class Point, class Nodes, class Visit>
void for_areas(const std::vector<Point>& x, const Nodes& facet, Visit visit) {
  Vec3<Pack> corner[F::nodes];
  facet_corners<F>(x, facet, corner);
  for (int q = 0; q < F::points; ++q) {
    const auto normal = F::weighted_normal(corner, q);
    visit(q, sqrt(dot(normal, normal))[0]);
  }
}

/// Integrals of N_a n over reference facets, mm^2, in a layout's vectors. Times a pressure they are its load; their dot
/// product with a velocity is the flow through the surface.
template <class Element, class Layout, class Point, class Facet>
std::vector<double> normal_weights(const std::vector<Point>& x, const std::vector<Facet>& facets) {
  using F = typename Element::Facet;
  std::vector<double> weights(Layout::size(static_cast<int>(x.size())), 0.0);
  for (const auto& facet : facets) {
    Vec3<Pack> corner[F::nodes];
    facet_corners<F>(x, facet, corner);
    for (int q = 0; q < F::points; ++q) {
      const auto normal = F::weighted_normal(corner, q);
      for (int a = 0; a < F::nodes; ++a)
        for (int k = 0; k < Element::components; ++k)
          weights[Layout::vector(facet[a], k)] += F::shape(q, a) * normal[Element::axis[k]][0];
    }
  }
  return weights;
}

/// Integrals of the scalar fields' shape functions over reference facets, one number per node, mm^2: their dot product
/// with a pressure is its integral.
template <class Element, class Point, class Facet>
std::vector<double> scalar_weights(const std::vector<Point>& x, const std::vector<Facet>& facets) {
  using F = typename Element::Facet;
  std::vector<double> weights(x.size(), 0.0);
  for (const auto& facet : facets)
    for_areas<F>(x, facet, [&](int q, double area) {
      for (int a = 0; a < F::scalar_nodes; ++a) weights[facet[a]] += F::scalar_shape(q, a) * area;
    });
  return weights;
}

/// Integrals of the vectors' shape functions over reference facets, one number per node, mm^2.
template <class Element, class Point, class Facet>
std::vector<double> vector_shape_integrals(const std::vector<Point>& x, const std::vector<Facet>& facets) {
  using F = typename Element::Facet;
  std::vector<double> integrals(x.size(), 0.0);
  for (const auto& facet : facets)
    for_areas<F>(x, facet, [&](int q, double area) {
      for (int a = 0; a < F::nodes; ++a) integrals[facet[a]] += F::shape(q, a) * area;
    });
  return integrals;
}

/// The area that belongs to each node, mm^2: positive, and adding up to the surface's. The integral of N_a where the
/// vectors' shape functions are linear; else each facet's area is distributed in the ratio of the integrals of N_a^2
/// [Hinton1976], since those of quadratic shape functions vanish at the vertices of triangles.
template <class Element, class Point, class Facet>
std::vector<double> nodal_areas(const std::vector<Point>& x, const std::vector<Facet>& facets) {
  if constexpr (Element::order == 1) {
    return vector_shape_integrals<Element>(x, facets);
  } else {
    using F = typename Element::Facet;
    std::vector<double> areas(x.size(), 0.0);
    for (const auto& facet : facets) {
      double total = 0, squares = 0, square[F::nodes] = {};
      for_areas<F>(x, facet, [&](int q, double area) {
        total += area;
        for (int a = 0; a < F::nodes; ++a) {
          square[a] += F::shape(q, a) * F::shape(q, a) * area;
          squares += F::shape(q, a) * F::shape(q, a) * area;
        }
      });
      for (int a = 0; a < F::nodes; ++a) areas[facet[a]] += total * square[a] / squares;
    }
    return areas;
  }
}

/// Integral of |u|^2/2 u . n over reference facets that do not move, mm^5/ms^3.
/// \param velocity  the vectors of a mixed layout
template <class Element, class Point, class Facet>
double kinetic_flux(const std::vector<Point>& x, const std::vector<Facet>& facets,
                    const std::vector<double>& velocity) {
  using F = typename Element::Facet;
  constexpr int n = Element::components;
  double flux = 0;
  for (const auto& facet : facets) {
    Vec3<Pack> corner[F::nodes];
    facet_corners<F>(x, facet, corner);
    for (int q = 0; q < F::cubic_points; ++q) {
      const auto normal = F::cubic_weighted_normal(corner, q);
      double square = 0, through = 0;
      for (int k = 0; k < n; ++k) {
        double u = 0;
        for (int a = 0; a < F::nodes; ++a) u += F::cubic_shape(q, a) * velocity[MixedLayout<n>::vector(facet[a], k)];
        square += u * u;
        through += u * normal[Element::axis[k]][0];
      }
      flux += 0.5 * square * through;
    }
  }
  return flux;
}

/// Adds the load of a pressure that follows a surface, (p n, v) over its current facets (outward normals).
/// \param pressure      kPa
/// \param displacement  the vectors of Layout, mm
/// \param residual      gets the load in the vectors of a mixed layout
/// \param jacobian      gets its derivative by displacements in the first n rows and columns of blocks; or null
template <class Element, class Layout, class Point, class Facet, class Matrix>
void add_surface_pressure(const std::vector<Point>& x, const std::vector<Facet>& facets, double pressure,
                          const double* displacement, double* residual, Matrix* jacobian) {
  using F = typename Element::Facet;
  constexpr int n = Element::components;
  using T = Dual<n>;
  for (const auto& facet : facets)
    for (int b = 0; b < (jacobian ? F::nodes : 1); ++b) {  // derivatives with respect to one node at a time
      Vec3<T> corner[F::nodes];
      for (int a = 0; a < F::nodes; ++a) {
        for (int i = 0; i < 3; ++i) corner[a][i] = T(x[facet[a]][i]);
        for (int k = 0; k < n; ++k) {
          corner[a][Element::axis[k]] += Pack(displacement[Layout::vector(facet[a], k)]);
          if (a == b) corner[a][Element::axis[k]].slope[k] = Pack(1.0);
        }
      }
      for (int q = 0; q < F::points; ++q) {
        const auto normal = F::weighted_normal(corner, q);
        for (int a = 0; a < F::nodes; ++a) {
          double* block = nullptr;
          if (jacobian) {
            const int position = jacobian->graph->find(facet[a], facet[b]);
            assert(position >= 0);
            block = jacobian->block(position);
          }
          for (int k = 0; k < n; ++k) {
            const T& component = normal[Element::axis[k]];
            const double scale = pressure * F::shape(q, a);
            if (b == 0) residual[MixedLayout<n>::vector(facet[a], k)] += scale * component.value[0];
            if (block)
              for (int s = 0; s < n; ++s) block[k * Matrix::columns + s] += scale * component.slope[s][0];
          }
        }
      }
    }
}

/// The same for displacements in the mixed layout, as a wall has them. \param solution  (d, p)
template <class Element, class Point, class Facet>
void add_follower_pressure(
    const std::vector<Point>& x, const std::vector<Facet>& facets, double pressure, const double* solution,
    std::vector<double>& residual,
    BlockMatrix<MixedLayout<Element::components>::entries, MixedLayout<Element::components>::entries>* jacobian) {
  add_surface_pressure<Element, MixedLayout<Element::components>>(x, facets, pressure, solution, residual.data(),
                                                                  jacobian);
}
template <class Element, class Point, class Facet, class Matrix>
void add_follower_pressure(const std::vector<Point>& x, const std::vector<Facet>& facets, double pressure,
                           const std::vector<double>& solution, std::vector<double>& residual, Matrix* jacobian) {
  add_follower_pressure<Element>(x, facets, pressure, solution.data(), residual, jacobian);
}

}  // namespace fsi
