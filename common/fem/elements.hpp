#pragma once

#include "fem/p1_tetrahedron.hpp"
#include "fem/p1_triangle.hpp"
#include "fem/p2p1_tetrahedron.hpp"
#include "fem/p2p1_triangle.hpp"

/// The elements that the libraries are compiled for: everything that depends on the element is declared in headers and
/// instantiated once, in its own .cpp file, by INSTANTIATE(element).
#define FSI_FOR_EACH_ELEMENT(INSTANTIATE)  \
  FSI_FOR_EACH_LINEAR_ELEMENT(INSTANTIATE) \
  FSI_FOR_EACH_QUADRATIC_ELEMENT(INSTANTIATE)
#define FSI_FOR_EACH_LINEAR_ELEMENT(INSTANTIATE) \
  INSTANTIATE(P1Tetrahedron)                     \
  INSTANTIATE(P1AxisymmetricTriangle)            \
  INSTANTIATE(P1PlaneTriangle)
#define FSI_FOR_EACH_QUADRATIC_ELEMENT(INSTANTIATE) \
  INSTANTIATE(P2P1Tetrahedron)                      \
  INSTANTIATE(P2P1AxisymmetricTriangle)             \
  INSTANTIATE(P2P1PlaneTriangle)
