#include "scene/boundary_conditions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "fem/elements.hpp"
#include "fem/facet_load.hpp"
#include "fem/held_components.hpp"
#include "mesh/boundary.hpp"
#include "mesh/group_names.hpp"
#include "mesh/symmetry_planes.hpp"
#include "scene/moving_openings.hpp"
#include "scene/wall_supports.hpp"

namespace fsi {

namespace {

/// A facet's vertices in ascending order.
template <class Element>
using VertexKey = std::array<int, Element::dim>;
template <class Element>
VertexKey<Element> vertex_key(const typename MeshOf<Element>::Facet& facet) {
  VertexKey<Element> key;
  std::copy_n(facet.begin(), key.size(), key.begin());
  std::sort(key.begin(), key.end());
  return key;
}

/// The facet with its normal turned round.
template <class Element>
typename MeshOf<Element>::Facet reversed(typename MeshOf<Element>::Facet facet) {
  constexpr int first = Element::dim - 2;  // two vertices change places, and with them the edges that they do not share
  std::swap(facet[first], facet[first + 1]);
  if constexpr (Element::dim == 3 && Element::order == 2) std::swap(facet[3], facet[5]);
  return facet;
}

/// Fixes these components of fields.
template <int n>
void fix(const VanishingComponents<n>& components, const std::vector<DirichletConditions<n>*>& conditions) {
  for (const std::size_t entry : components.entries)
    for (auto* condition : conditions) condition->fix(static_cast<int>(entry) / n, static_cast<int>(entry) % n);
}

/// Facets of the fluid's boundary at which it sticks: those in none of the given sets and not on the axis.
template <class Element>
FacetsOf<Element> closed_facets(const MeshOf<Element>& mesh, const std::vector<FacetsOf<Element>>& others) {
  std::vector<VertexKey<Element>> known;
  for (const auto& facets : others)
    for (const auto& facet : facets) known.push_back(vertex_key<Element>(facet));
  std::sort(known.begin(), known.end());
  FacetsOf<Element> closed;
  for (const auto& facet : boundary_facets(mesh, {mesh.region_index(group::fluid)})) {
    if (std::binary_search(known.begin(), known.end(), vertex_key<Element>(facet.nodes))) continue;
    if constexpr (Element::axisymmetric)
      if (std::all_of(facet.nodes.begin(), facet.nodes.end(), [&](int node) { return mesh.nodes[node][0] == 0; }))
        continue;
    closed.push_back(facet.nodes);
  }
  return closed;
}

}  // namespace

template <class Element>
std::vector<char> nodes_on(const PartOf<Element>& part, const FacetsOf<Element>& facets) {
  std::vector<char> marks(part.nodes.size(), 0);
  for (const auto& facet : facets)
    for (int node : facet)
      if (part.local_node[node] >= 0) marks[part.local_node[node]] = 1;
  part.spread_to_copies(marks);
  return marks;
}

template <class Element>
FacetsOf<Element> in_part(const PartOf<Element>& part, const FacetsOf<Element>& facets) {
  FacetsOf<Element> local;
  local.reserve(facets.size());
  for (const auto& facet : facets) local.push_back(part.local(facet));
  name_copies_of_cells(part, local);
  return local;
}

template <class Element>
FacetsOf<Element> inner_surface(const MeshOf<Element>& mesh, const std::vector<int>& wall_regions) {
  const int fluid = mesh.region_index(group::fluid);
  if (fluid < 0) return group_facets(mesh, group::inner);
  FacetsOf<Element> facets = interface_facets(mesh, fluid, wall_regions);
  for (auto& facet : facets) facet = reversed<Element>(facet);
  return facets;
}

template <class Element>
HeldDirections<Element>::HeldDirections(const MeshOf<Element>& mesh, const PartOf<Element>& part,
                                        std::vector<HeldSurface<n>> others)
    : part_(part), others_(std::move(others)) {
  for (const auto& plane : symmetry_planes(mesh)) {
    Direction<n> normal;
    for (int k = 0; k < n; ++k) normal[k] = plane.normal[Element::axis[k]];
    planes_.push_back({nodes_on<Element>(part, plane.group->facets), normal});
  }
}

template <class Element>
auto HeldDirections<Element>::of_symmetry(int node) const -> std::vector<Direction<n>> {
  std::vector<Direction<n>> directions;
  for (const auto& plane : planes_)
    if (plane.on[node]) directions.push_back(plane.direction);
  if (Element::axisymmetric && part_.nodes[node][0] == 0) {
    directions.emplace_back();
    directions.back()[0] = 1;
  }
  return directions;
}

template <class Element>
auto HeldDirections<Element>::at(int node) const -> std::vector<Direction<n>> {
  auto directions = of_symmetry(node);
  for (const auto& surface : others_)
    if (surface.on[node]) directions.push_back(surface.direction);
  return directions;
}

template <class Element>
VanishingComponents<Element::components> mirrored_components(
    const MeshOf<Element>& mesh, const PartOf<Element>& part,
    const std::vector<HeldSurface<Element::components>>& surfaces) {
  constexpr int n = Element::components;
  const HeldDirections<Element> directions(mesh, part, surfaces);
  VanishingComponents<n> mirrored;
  for (int a = 0; a < part.node_count(); ++a) {
    const auto normals = directions.at(a);
    if (normals.empty()) continue;
    const auto held = hold<n>(normals);
    if (held.turned) mirrored.frames.turn(a, held.axes);
    for (int k = 0; k < n; ++k)
      if (held.held[k]) mirrored.entries.push_back(VectorLayout<n>::vector(a, k));
  }
  return mirrored;
}

template <class Element>
WallConditions<Element::components> wall_conditions(const Case& setup, const MeshOf<Element>& mesh,
                                                    const PartOf<Element>& wall) {
  WallConditions<Element::components> held{DirichletConditions<Element::components>(wall.node_count()), {}};
  if (setup.supports.count(group::wall_ends) == 0) {
    const auto ends = nodes_on<Element>(wall, group_facets(mesh, group::wall_ends));
    for (int a = 0; a < wall.node_count(); ++a)
      if (ends[a]) held.conditions.fix(a);
  }
  auto components = mirrored_components<Element>(mesh, wall, surfaces_held_by_supports<Element>(setup, mesh, wall));
  fix<Element::components>(components, {&held.conditions});
  held.frames = std::move(components.frames);
  return held;
}

template <class Element>
FluidBoundary<Element> fluid_boundary(const std::vector<OpeningData>& openings, const MeshOf<Element>& mesh,
                                      const PartOf<Element>& fluid, const FacetsOf<Element>& interface,
                                      const WallSide<Element>* wall) {
  constexpr int n = Element::components;
  const int nodes = fluid.node_count();
  FluidBoundary<Element> boundary;
  boundary.velocity = boundary.mesh = DirichletConditions<n>(nodes);
  std::vector<FacetsOf<Element>> not_closed{interface};
  for (const auto& plane : symmetry_planes(mesh)) not_closed.push_back(plane.group->facets);
  for (const auto& opening : openings) {
    const FacetsOf<Element> facets = group_facets(mesh, opening.surface);
    not_closed.push_back(facets);
    boundary.open.push_back(open_boundary<Element>(opening.surface, fluid.nodes, in_part<Element>(fluid, facets)));
  }
  const auto wet = nodes_on<Element>(fluid, interface);
  const auto moving = wall ? moving_openings<Element>(mesh, fluid, boundary.open, wet, *wall)
                           : std::vector<std::optional<MovingOpening<n>>>(openings.size());
  for (std::size_t i = 0; i < openings.size(); ++i) {
    const FacetsOf<Element> facets = group_facets(mesh, openings[i].surface);
    if (moving[i]) {
      boundary.open[i].move_by(moving_surface<Element>(fluid.nodes, in_part<Element>(fluid, facets)));
      continue;
    }
    const auto on = nodes_on<Element>(fluid, facets);
    for (int a = 0; a < nodes; ++a)
      if (on[a]) boundary.mesh.fix(a);
  }
  const auto closed_here = closed_facets<Element>(mesh, not_closed);
  const auto closed_areas = nodal_areas<Element>(fluid.nodes, in_part<Element>(fluid, closed_here));
  boundary.closed_area = std::accumulate(closed_areas.begin(), closed_areas.end(), 0.0);
  const auto closed = nodes_on<Element>(fluid, closed_here);
  for (int a = 0; a < nodes; ++a)
    if (closed[a]) {
      boundary.velocity.fix(a);
      boundary.mesh.fix(a);
    }
  boundary.mirrored = mirrored_components<Element>(mesh, fluid);
  if (std::none_of(moving.begin(), moving.end(), [](const auto& opening) { return opening.has_value(); })) {
    fix<n>(boundary.mirrored, {&boundary.velocity, &boundary.mesh});
    boundary.frames = boundary.mirrored.frames;
  } else {
    hold_with_openings<Element>(mesh, fluid, moving, wet, *wall, boundary);
  }
  for (std::size_t i = 0; i < openings.size(); ++i) {
    if (!openings[i].flow_rate || boundary.open[i].empty() || moving[i]) continue;
    InflowNodes inflow{i, {}, std::vector<char>(nodes, 0)};
    const auto on = nodes_on<Element>(fluid, group_facets(mesh, openings[i].surface));
    for (int a = 0; a < nodes; ++a) {
      inflow.sticking[a] = closed[a] || wet[a];
      if (!on[a] || inflow.sticking[a]) continue;
      boundary.velocity.fix(a);
      inflow.nodes.push_back(a);
    }
    boundary.inflows.push_back(std::move(inflow));
  }
  const auto areas = nodal_areas<Element>(fluid.nodes, in_part<Element>(fluid, interface));
  for (int a = 0; a < nodes; ++a) {
    if (!wet[a]) continue;
    const int wall_node = wall->part.local_node[fluid.mesh_node[a]];
    const auto& held = wall->held.conditions;
    const bool clamped = held.fixes(wall_node);
    for (int k = 0; k < n; ++k)
      if (held.fixes(wall_node, k) || boundary.velocity.fixes(a, k)) {
        boundary.velocity.fix(a, k);
        boundary.mesh.fix(a, k);
      }
    boundary.interface.push_back({a, wall_node, clamped});
    boundary.interface_areas.push_back(areas[a]);
  }
  return boundary;
}

#define FSI_INSTANTIATE(Element)                                                                                   \
  template class HeldDirections<Element>;                                                                          \
  template std::vector<char> nodes_on<Element>(const PartOf<Element>&, const FacetsOf<Element>&);                  \
  template VanishingComponents<Element::components> mirrored_components<Element>(                                  \
      const MeshOf<Element>&, const PartOf<Element>&, const std::vector<HeldSurface<Element::components>>&);       \
  template FacetsOf<Element> in_part<Element>(const PartOf<Element>&, const FacetsOf<Element>&);                   \
  template FacetsOf<Element> inner_surface<Element>(const MeshOf<Element>&, const std::vector<int>&);              \
  template WallConditions<Element::components> wall_conditions<Element>(const Case&, const MeshOf<Element>&,       \
                                                                        const PartOf<Element>&);                   \
  template FluidBoundary<Element> fluid_boundary<Element>(const std::vector<OpeningData>&, const MeshOf<Element>&, \
                                                          const PartOf<Element>&, const FacetsOf<Element>&,        \
                                                          const WallSide<Element>*);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
