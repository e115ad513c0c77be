#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fem/facet_load.hpp"
#include "fluid/inflow_profile.hpp"
#include "mesh/surface_pieces.hpp"

namespace fsi {

/// Scales a profile w along `inward` to a discrete flow of one into the fluid. \param w  one real or complex number per
/// entry of `nodes`; 1/mm^2 afterwards
template <class Element, class Number>
void scale_to_unit_flow(const InflowOpening<Element>& opening, const std::vector<int>& nodes, const Point& inward,
                        std::vector<Number>& w) {
  constexpr int n = Element::components;
  const auto weights = normal_weights<Element, VectorLayout<n>>(opening.nodes, opening.facets);
  Number flow = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int k = 0; k < n; ++k) flow -= weights[VectorLayout<n>::vector(nodes[i], k)] * inward[Element::axis[k]] * w[i];
  for (Number& value : w) value /= flow;
}

// Sentences for UnitInflow::instead.

template <class Element>
std::string says_no_rim(const InflowOpening<Element>& opening) {
  return "the fluid sticks nowhere on the rim of the surface " + opening.name +
         ": the same velocity is let in everywhere, a plug";
}
template <class Element>
std::string says_own_shape(const InflowOpening<Element>& opening) {
  const char* ideal = Element::dim == 3       ? "no flat circle"
                      : Element::axisymmetric ? "no flat circle about the axis"
                                              : "not straight between walls";
  const SurfacePieces pieces = pieces_of<Element::dim>(opening.nodes, opening.facets);
  const std::string why = pieces.pieces.size() > 1 ? " but in pieces"
                          : pieces.leaning.empty() ? ""
                                                   : " since some of its facets lean away from its plane";
  return "the surface " + opening.name + " is " + ideal + why +
         ": the flow that is fully developed on its own facets is let in, the discrete solution of -Laplace w = 1";
}

}  // namespace fsi
