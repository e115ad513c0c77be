#pragma once

#include <type_traits>
#include <utility>

#include "math/tensor.hpp"

namespace fsi {

/// Stands for the size and the metric of an element that needs no stabilisation.
struct Unstabilised {};
/// What an element has for a metric: Sym3<Pack> or Unstabilised.
template <class Element>
using MetricOf = std::decay_t<decltype(std::declval<typename Element::Geometry&>().metric)>;

/// Shape functions of one field at one quadrature point.
template <int Nodes>
struct ShapeFunctions {
  double value[Nodes];         ///< N_a
  Vec3<Pack> gradient[Nodes];  ///< grad N_a on the reference domain, 1/mm
  Pack hoop[Nodes];            ///< N_a / r, 1/mm; not set unless the element is axisymmetric
};

/// What a weak form may know of an element at one quadrature point: the shape functions of vector and of scalar fields
/// and the integration weight. Here for elements whose scalar fields live on other nodes than their vector fields.
template <int VectorNodes, int ScalarNodes>
struct PointGeometry {
  Pack weight;  ///< mm^3
  ShapeFunctions<VectorNodes> of_vectors;
  ShapeFunctions<ScalarNodes> of_scalars;

  const ShapeFunctions<VectorNodes>& vectors() const { return of_vectors; }
  const ShapeFunctions<ScalarNodes>& scalars() const { return of_scalars; }
};

/// The same for elements of equal order, whose shape functions serve vectors and scalars.
template <int Nodes>
struct PointGeometry<Nodes, Nodes> {
  Pack weight;  ///< mm^3
  ShapeFunctions<Nodes> of_all;

  const ShapeFunctions<Nodes>& vectors() const { return of_all; }
  const ShapeFunctions<Nodes>& scalars() const { return of_all; }
};

}  // namespace fsi
