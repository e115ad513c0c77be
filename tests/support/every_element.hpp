#pragma once

#include <gtest/gtest.h>

#include <string>

#include "fem/elements.hpp"

namespace fsi::test {

/// For TYPED_TEST_SUITE(name, Elements, ElementNames): the tests of the suite for each element and kind of geometry.
using Elements = testing::Types<P1Tetrahedron, P1AxisymmetricTriangle, P1PlaneTriangle, P2P1Tetrahedron,
                                P2P1AxisymmetricTriangle, P2P1PlaneTriangle>;

/// Names of their tests, such as "EveryElement/P2P1PlaneTriangle".
struct ElementNames {
  template <class Element>
  static std::string GetName(int) {
    return std::string(Element::order == 1 ? "P1" : "P2P1") + (Element::dim == 3       ? "Tetrahedron"
                                                               : Element::axisymmetric ? "AxisymmetricTriangle"
                                                                                       : "PlaneTriangle");
  }
};

}  // namespace fsi::test
