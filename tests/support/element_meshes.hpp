#pragma once

#include <cmath>
#include <string>

#include "mesh/mid_edge_nodes.hpp"
#include "support/meshes.hpp"

namespace fsi::test {

/// A mesh of the element's kind, n boxes a side, irregular inside, edges straight: the unit cube, the unit square
/// 0 < x, y < 1 or the ring of inner radius `inner`, 1 mm thick and long.
template <class Element>
SimplexMesh<Element::dim, Element::order> irregular_mesh(int n, const std::string& region = "fluid", double inner = 1) {
  const auto linear = [&] {
    if constexpr (Element::dim == 3) {
      return irregular_cube(n, 0.15, region);
    } else {
      auto mesh = irregular_ring(n, region, Element::axisymmetric ? inner : 0);
      if constexpr (!Element::axisymmetric)
        for (auto& x : mesh.nodes) x = {x[0], x[2], 0};
      return mesh;
    }
  }();
  if constexpr (Element::order == 1) {
    return linear;
  } else {
    return with_mid_edge_nodes(linear);
  }
}

/// Moves all nodes by a smooth map, so that quadratic edges are curved. The axis of a body of revolution stays.
template <class Element>
void curve(SimplexMesh<Element::dim, Element::order>& mesh, double amount) {
  for (auto& x : mesh.nodes) {
    const Point old = x;
    for (int k = 0; k < Element::components; ++k) {
      const int i = Element::axis[k], j = Element::axis[(k + 1) % Element::components];
      x[i] += amount * std::sin(2 * old[j] + 1 + k) * (Element::axisymmetric && k == 0 ? old[0] : old[i] + 0.5);
    }
  }
}

}  // namespace fsi::test
