#pragma once

#include <type_traits>

#include "fem/compiled_elements.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "fem/p1_triangle.hpp"
#include "fem/p2p1_tetrahedron.hpp"
#include "fem/p2p1_triangle.hpp"

/// The elements that the libraries are compiled for: everything that depends on the element is declared in headers and
/// instantiated once, in its own .cpp file, by INSTANTIATE(element). With the CMake option FSI_FIRST_ELEMENT, which
/// compiled_elements.hpp passes on, linear tetrahedra alone: the first report of scripts/quickstart.sh needs no more.
#define FSI_FOR_EACH_ELEMENT(INSTANTIATE)  \
  FSI_FOR_EACH_LINEAR_ELEMENT(INSTANTIATE) \
  FSI_FOR_EACH_QUADRATIC_ELEMENT(INSTANTIATE)
#ifdef FSI_FIRST_ELEMENT
#define FSI_FOR_EACH_LINEAR_ELEMENT(INSTANTIATE) INSTANTIATE(P1Tetrahedron)
#define FSI_FOR_EACH_QUADRATIC_ELEMENT(INSTANTIATE)
#else
#define FSI_FOR_EACH_LINEAR_ELEMENT(INSTANTIATE) \
  INSTANTIATE(P1Tetrahedron)                     \
  INSTANTIATE(P1AxisymmetricTriangle)            \
  INSTANTIATE(P1PlaneTriangle)
#define FSI_FOR_EACH_QUADRATIC_ELEMENT(INSTANTIATE) \
  INSTANTIATE(P2P1Tetrahedron)                      \
  INSTANTIATE(P2P1AxisymmetricTriangle)             \
  INSTANTIATE(P2P1PlaneTriangle)
#endif

namespace fsi {

/// Whether the libraries are compiled for an element.
template <class Element>
inline constexpr bool is_compiled =
#ifdef FSI_FIRST_ELEMENT
    std::is_same_v<Element, P1Tetrahedron>;
#else
    true;
#endif

}  // namespace fsi
