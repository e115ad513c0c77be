#pragma once

#include <vector>

#include "algebra/block_matrix.hpp"
#include "math/tensor.hpp"

namespace fsi {

/// Integrals of N_a n over reference facets, `stride` entries per node (the first `components` used): times a pressure
/// the load of that pressure, as a dot product with a velocity the flow through the surface.
template <class Element, class Point, class Facet>
std::vector<double> normal_weights(const std::vector<Point>& x, const std::vector<Facet>& facets, int stride) {
  using F = typename Element::Facet;
  std::vector<double> weights(x.size() * stride, 0.0);
  for (const auto& facet : facets) {
    Vec3<Pack> corner[F::nodes];
    for (int a = 0; a < F::nodes; ++a)
      for (int i = 0; i < 3; ++i) corner[a][i] = Pack(x[facet[a]][i]);
    for (int q = 0; q < F::points; ++q) {
      const auto normal = F::weighted_normal(corner, q);
      for (int a = 0; a < F::nodes; ++a)
        for (int k = 0; k < Element::components; ++k)
          weights[static_cast<std::size_t>(facet[a]) * stride + k] += F::shape(q, a) * normal[Element::axis[k]][0];
    }
  }
  return weights;
}

/// Integrals of N_a over reference facets, one per node, mm^2.
template <class Element, class Point, class Facet>
std::vector<double> area_weights(const std::vector<Point>& x, const std::vector<Facet>& facets) {
  using F = typename Element::Facet;
  std::vector<double> weights(x.size(), 0.0);
  for (const auto& facet : facets) {
    Vec3<Pack> corner[F::nodes];
    for (int a = 0; a < F::nodes; ++a)
      for (int i = 0; i < 3; ++i) corner[a][i] = Pack(x[facet[a]][i]);
    for (int q = 0; q < F::points; ++q) {
      const auto normal = F::weighted_normal(corner, q);
      const double area = sqrt(dot(normal, normal))[0];
      for (int a = 0; a < F::nodes; ++a) weights[facet[a]] += F::shape(q, a) * area;
    }
  }
  return weights;
}

/// Integral of |u|^2/2 u . n over reference facets that do not move, mm^5/ms^3. \param velocity  in the first
/// `components` of `components + 1` numbers per node
template <class Element, class Point, class Facet>
double kinetic_flux(const std::vector<Point>& x, const std::vector<Facet>& facets,
                    const std::vector<double>& velocity) {
  using F = typename Element::Facet;
  constexpr int n = Element::components;
  double flux = 0;
  for (const auto& facet : facets) {
    Vec3<Pack> corner[F::nodes];
    for (int a = 0; a < F::nodes; ++a)
      for (int i = 0; i < 3; ++i) corner[a][i] = Pack(x[facet[a]][i]);
    for (int q = 0; q < F::cubic_points; ++q) {
      const auto normal = F::cubic_weighted_normal(corner, q);
      double square = 0, through = 0;
      for (int k = 0; k < n; ++k) {
        double u = 0;
        for (int a = 0; a < F::nodes; ++a)
          u += F::cubic_shape(q, a) * velocity[static_cast<std::size_t>(facet[a]) * (n + 1) + k];
        square += u * u;
        through += u * normal[Element::axis[k]][0];
      }
      flux += 0.5 * square * through;
    }
  }
  return flux;
}

/// Adds the load of a pressure that follows the surface, (p n, v) over the current facets (outward normals), and, if
/// blocks are passed, its derivative with respect to the nodes' displacement. \param solution  displacement in the
/// first `components` of `components + 1` numbers per node
template <class Element, class Point, class Facet>
void add_follower_pressure(const std::vector<Point>& x, const std::vector<Facet>& facets, double pressure,
                           const std::vector<double>& solution, std::vector<double>& residual,
                           BlockMatrix<Element::components + 1, Element::components + 1>* jacobian) {
  using F = typename Element::Facet;
  constexpr int n = Element::components;
  using T = Dual<n>;
  for (const auto& facet : facets)
    for (int b = 0; b < F::nodes; ++b) {  // derivatives with respect to one node at a time
      Vec3<T> corner[F::nodes];
      for (int a = 0; a < F::nodes; ++a) {
        for (int i = 0; i < 3; ++i) corner[a][i] = T(x[facet[a]][i]);
        for (int k = 0; k < n; ++k) {
          corner[a][Element::axis[k]] += Pack(solution[static_cast<std::size_t>(facet[a]) * (n + 1) + k]);
          if (a == b) corner[a][Element::axis[k]].slope[k] = Pack(1.0);
        }
      }
      for (int q = 0; q < F::points; ++q) {
        const auto normal = F::weighted_normal(corner, q);
        for (int a = 0; a < F::nodes; ++a)
          for (int k = 0; k < n; ++k) {
            const T& component = normal[Element::axis[k]];
            const double scale = pressure * F::shape(q, a);
            if (b == 0) residual[static_cast<std::size_t>(facet[a]) * (n + 1) + k] += scale * component.value[0];
            if (jacobian)
              for (int s = 0; s < n; ++s)
                jacobian->block(jacobian->graph->find(facet[a], facet[b]))[k * (n + 1) + s] +=
                    scale * component.slope[s][0];
          }
      }
    }
}

}  // namespace fsi
