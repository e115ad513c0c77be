#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

#include "mesh/boundary.hpp"
#include "mesh/group_names.hpp"
#include "scene/boundary_conditions.hpp"
#include "support/element_meshes.hpp"
#include "support/orthogonal.hpp"
#include "support/scenes.hpp"

namespace fsi::test {

inline Case fluid_case(double density, double viscosity) {
  Case setup = coupled_case("neo-hookean");
  setup.structure.reset();
  setup.fluid->density = density;
  setup.fluid->viscosity = viscosity;
  return setup;
}

template <class Element>
void name_surface(MeshOf<Element>& mesh, const std::string& name, int axis, double value) {
  typename MeshOf<Element>::FacetGroup group{name, {}};
  for (const auto& facet : boundary_facets(mesh))
    if (std::all_of(facet.nodes.begin(), facet.nodes.end(),
                    [&](int node) { return std::abs(mesh.nodes[node][axis] - value) < 1e-12; }))
      group.facets.push_back(facet.nodes);
  mesh.facet_groups.push_back(std::move(group));
}

/// Where flow through the unit cube, square or ring goes, and across: coordinates from 0 (the ring's first radius) to 1
/// (its second).
template <class Element>
constexpr int along_axis = Element::axisymmetric ? 2 : 0;
template <class Element>
constexpr int across_axis = Element::axisymmetric ? 0 : 1;

/// irregular_mesh() with inlet and outlet at its ends and the surfaces `lower` and `upper` across.
template <class Element>
MeshOf<Element> channel(int n, double first_radius = 1) {
  auto mesh = irregular_mesh<Element>(n, "fluid", first_radius);
  const double first = Element::axisymmetric ? first_radius : 0;
  name_surface<Element>(mesh, group::inlet, along_axis<Element>, 0);
  name_surface<Element>(mesh, group::outlet, along_axis<Element>, 1);
  name_surface<Element>(mesh, "lower", across_axis<Element>, first);
  name_surface<Element>(mesh, "upper", across_axis<Element>, first + 1);
  return mesh;
}

/// The mesh turned or mirrored; cells and facets positively oriented.
template <class Element>
MeshOf<Element> turned(MeshOf<Element> mesh, const Mat3<double>& q, bool mirrors) {
  for (Point& x : mesh.nodes) x = turn(q, x);
  if (!mirrors) return mesh;
  // Two vertices change places, and with them the edges that they do not share.
  const auto swap_first = [](auto& nodes, auto dim) {
    std::swap(nodes[0], nodes[1]);
    constexpr int first = decltype(dim)::value + 1;
    if constexpr (Element::order == 2 && first > 2) std::swap(nodes[first + 1], nodes[first + 2]);
    if constexpr (Element::order == 2 && first > 3) std::swap(nodes[first + 3], nodes[first + 4]);
  };
  for (auto& cell : mesh.cells) swap_first(cell, std::integral_constant<int, Element::dim>());
  for (auto& group : mesh.facet_groups)
    for (auto& facet : group.facets) swap_first(facet, std::integral_constant<int, Element::dim - 1>());
  return mesh;
}

}  // namespace fsi::test
