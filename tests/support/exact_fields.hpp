#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "fem/quadratic_simplex.hpp"
#include "fem/triangle_bodies.hpp"
#include "math/tensor.hpp"
#include "mesh/simplex_mesh.hpp"

namespace fsi::test {

/// Value and 3 x 3 gradient of a vector field, the hoop term of bodies of revolution in (1, 1).
struct ExactVector {
  Vec3<Pack> value;
  Mat3<Pack> gradient;
};

/// A smooth vector field on an element's axes: component k is amplitude * sin(a_k . x + phase + k), times r for the radial
/// one of a body of revolution, so that it vanishes on the axis.
template <class Element>
struct SineField {
  double amplitude, phase;

  ExactVector at(const Point& x) const {
    ExactVector f;
    for (int i = 0; i < 3; ++i) {
      f.value[i] = Pack(0.0);
      for (int j = 0; j < 3; ++j) f.gradient(i, j) = Pack(0.0);
    }
    for (int k = 0; k < Element::components; ++k) {
      const int i = Element::axis[k];
      double argument = phase + k;
      std::array<double, 3> wave{};
      for (int j = 0; j < Element::dim; ++j) {
        wave[j] = 1.1 + 0.4 * k + 0.7 * j - 0.5 * k * j;
        argument += wave[j] * x[Element::axis[j]];
      }
      const bool radial = Element::axisymmetric && k == 0;
      const double factor = amplitude * (radial ? x[0] : 1.0), sine = std::sin(argument);
      f.value[i] = Pack(factor * sine);
      for (int j = 0; j < Element::dim; ++j)
        f.gradient(i, Element::axis[j]) = Pack(factor * wave[j] * std::cos(argument));
      if (radial) {
        f.gradient(0, 0) += Pack(amplitude * sine);
        f.gradient(1, 1) = Pack(amplitude * sine);
      }
    }
    return f;
  }
};

/// A quadrature point of a cell, with shape functions that owe nothing to the element's own geometry and rule.
template <class Element>
struct ElementPoint {
  Point x{};
  double weight = 0;  ///< mm^3
  double shape[Element::nodes] = {};
  Point gradient[Element::nodes] = {};  ///< 1/mm
  double scalar_shape[Element::scalar_nodes] = {};
};

/// Visits the points of the conical Gauss rule, 5 a direction, exact for degree 7 in three dimensions, on every cell.
template <class Element, class Visit>
void visit_points(const SimplexMesh<Element::dim, Element::order>& mesh, Visit visit) {
  constexpr int dim = Element::dim;
  constexpr double a = 0.53846931010568309104, b = 0.90617984593866399280;
  constexpr double wa = 0.47862867049936646804, wb = 0.23692688505618908751, w0 = 0.56888888888888888889;
  const double s[5] = {0.5 - b / 2, 0.5 - a / 2, 0.5, 0.5 + a / 2, 0.5 + b / 2};
  const double w[5] = {wb / 2, wa / 2, w0 / 2, wa / 2, wb / 2};
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (int point = 0; point < (dim == 3 ? 125 : 25); ++point) {
      const int i = point % 5, j = point / 5 % 5, k = point / 25;
      std::array<double, dim + 1> l{};
      double weight = w[i] * w[j] * (1 - s[i]);
      l[1] = s[i];
      l[2] = (1 - s[i]) * s[j];
      if constexpr (dim == 3) {
        l[3] = (1 - s[i]) * (1 - s[j]) * s[k];
        weight *= w[k] * (1 - s[i]) * (1 - s[j]);
      }
      l[0] = 1;
      for (int v = 1; v <= dim; ++v) l[0] -= l[v];

      ElementPoint<Element> p;
      double slope[Element::nodes][dim];  // by l_1, l_2, ... with l_0 = 1 - the others
      for (int node = 0; node < Element::nodes; ++node) {
        if constexpr (Element::order == 2) {
          p.shape[node] = QuadraticSimplex<dim>::shape(l, node);
          for (int v = 0; v < dim; ++v)
            slope[node][v] = QuadraticSimplex<dim>::slope(l, node, v + 1) - QuadraticSimplex<dim>::slope(l, node, 0);
        } else {
          p.shape[node] = l[node];
          for (int v = 0; v < dim; ++v) slope[node][v] = (node == v + 1) - (node == 0);
        }
      }
      for (int v = 0; v < Element::scalar_nodes; ++v) p.scalar_shape[v] = l[v];
      // Columns of dx/dl, on the element's axes, and the inverse by Cramer's rule; the third row and column are the
      // identity's in two dimensions.
      Mat3<double> jacobian{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
      for (int m = 0; m < dim; ++m)
        for (int v = 0; v < dim; ++v) {
          jacobian(m, v) = 0;
          for (int node = 0; node < Element::nodes; ++node)
            jacobian(m, v) += slope[node][v] * mesh.nodes[mesh.cells[c][node]][Element::axis[m]];
        }
      for (int node = 0; node < Element::nodes; ++node)
        for (int m = 0; m < 3; ++m) p.x[m] += p.shape[node] * mesh.nodes[mesh.cells[c][node]][m];
      const auto cofactors = cofactor(jacobian);
      double det = 0;
      for (int v = 0; v < 3; ++v) det += jacobian(0, v) * cofactors(0, v);
      for (int node = 0; node < Element::nodes; ++node)
        for (int m = 0; m < dim; ++m)
          for (int v = 0; v < dim; ++v) p.gradient[node][Element::axis[m]] += cofactors(m, v) / det * slope[node][v];
      p.weight = weight * det * (Element::axisymmetric ? two_pi * p.x[0] : 1.0);
      visit(mesh.cells[c], p);
    }
}

/// The field that nodal values describe at a point.
template <class Element, class Cell>
ExactVector discrete_vector(const std::vector<double>& field, int entries, const Cell& cell,
                            const ElementPoint<Element>& p) {
  ExactVector f;
  for (int i = 0; i < 3; ++i) {
    f.value[i] = Pack(0.0);
    for (int j = 0; j < 3; ++j) f.gradient(i, j) = Pack(0.0);
  }
  for (int a = 0; a < Element::nodes; ++a)
    for (int k = 0; k < Element::components; ++k) {
      const double nodal = field[static_cast<std::size_t>(entries) * cell[a] + k];
      f.value[Element::axis[k]] += Pack(nodal * p.shape[a]);
      for (int j = 0; j < 3; ++j) f.gradient(Element::axis[k], j) += Pack(nodal * p.gradient[a][j]);
    }
  if (Element::axisymmetric) f.gradient(1, 1) = Pack(f.value[0][0] / p.x[0]);
  return f;
}

}  // namespace fsi::test
