#include "fluid/inflow_profile.hpp"

#include <cstddef>

#include "base/error.hpp"
#include "fem/elements.hpp"
#include "fluid/opening_profile.hpp"
#include "fluid/opening_shape.hpp"
#include "fluid/scaled_profile.hpp"
#include "mesh/boundary.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

/// The velocity of a profile, one number per node of the opening.
template <class Element>
UnitInflow unit_inflow(const InflowOpening<Element>& opening, const std::vector<int>& nodes, const Point& inward,
                       std::vector<double> w, std::string instead) {
  constexpr int n = Element::components;
  scale_to_unit_flow(opening, nodes, inward, w);
  UnitInflow unit{std::vector<double>(VectorLayout<n>::size(static_cast<int>(opening.nodes.size())), 0.0),
                  std::move(instead)};
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int k = 0; k < n; ++k) unit.velocity[VectorLayout<n>::vector(nodes[i], k)] = w[i] * inward[Element::axis[k]];
  return unit;
}

template <class Element>
UnitInflow plug(const InflowOpening<Element>& opening, const OpeningShape& shape, std::string instead) {
  const auto nodes = facet_nodes(opening.facets);
  std::vector<double> w;
  for (const int a : nodes) w.push_back(opening.sticking[a] ? 0.0 : 1.0);
  return unit_inflow(opening, nodes, shape.inward, std::move(w), std::move(instead));
}

}  // namespace

template <class Element>
UnitInflow plug_inflow(const InflowOpening<Element>& opening) {
  return plug(opening, shape_of(opening), "");
}

template <class Element>
UnitInflow parabolic_inflow(const InflowOpening<Element>& opening) {
  const OpeningShape shape = shape_of(opening);
  if (!shape.walled) return plug(opening, shape, says_no_rim(opening));
  const auto nodes = facet_nodes(opening.facets);
  std::vector<double> w;
  if (shape.kind == OpeningShape::Kind::other) {
    for (const auto& value : developed_flow(opening, nodes, 0.0)) w.push_back(value.real());
    return unit_inflow(opening, nodes, shape.inward, std::move(w), says_own_shape(opening));
  }
  for (const int a : nodes) {
    const double s = distance(opening.nodes[a], shape.centre) / shape.radius;
    w.push_back(opening.sticking[a] ? 0.0 : 1 - s * s);
  }
  return unit_inflow(opening, nodes, shape.inward, std::move(w), "");
}

template <class Element>
UnitInflow biparabolic_inflow(const InflowOpening<Element>& opening) {
  const OpeningShape shape = shape_of(opening);
  const auto rectangle = rectangle_of(opening, shape.inward);
  if (!rectangle)
    throw InputError(
        opening.file, "opening." + opening.name + ".profile",
        "\"biparabolic\" is the profile of a flat rectangle of three dimensions between walls and planes of "
        "symmetry, and this surface is none",
        "take profile = \"parabolic\"");
  const auto nodes = facet_nodes(opening.facets);
  std::vector<double> w;
  for (const int a : nodes) w.push_back(opening.sticking[a] ? 0.0 : rectangle->parabolas(opening.nodes[a]));
  return unit_inflow(opening, nodes, shape.inward, std::move(w), "");
}

#define FSI_INSTANTIATE(Element)                                                \
  template UnitInflow plug_inflow<Element>(const InflowOpening<Element>&);      \
  template UnitInflow parabolic_inflow<Element>(const InflowOpening<Element>&); \
  template UnitInflow biparabolic_inflow<Element>(const InflowOpening<Element>&);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
