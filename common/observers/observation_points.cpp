#include "observers/observation_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "fem/elements.hpp"
#include "mesh/boundary.hpp"
#include "mesh/disjoint_sets.hpp"
#include "mesh/group_names.hpp"
#include "mesh/point_math.hpp"
#include "mesh/symmetry_planes.hpp"
#include "sampling/point_sampling.hpp"
#include "sampling/wall_sampling.hpp"

namespace fsi {

namespace {

constexpr int line_points = 181;

template <class Facets>
Point centre_of(const std::vector<Point>& nodes, const Facets& surface) {
  Point sum{0, 0, 0};
  double count = 0;
  for (const auto& facet : surface)
    for (int node : facet) {
      sum = sum + nodes[node];
      ++count;
    }
  return (1 / count) * sum;
}

/// Number of connected pieces of a surface; facets that share a node are connected.
template <class Facets>
int pieces_of(const Facets& surface) {
  const auto nodes = facet_nodes(surface);
  const auto number = [&](int node) {
    return static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
  };
  DisjointSets sets(nodes.size());
  for (const auto& facet : surface)
    for (const int node : facet) sets.join(number(facet[0]), number(node));
  int count = 0;
  for (int i = 0; i < static_cast<int>(nodes.size()); ++i) count += sets.root(i) == i;
  return count;
}

/// The middle of an opening, with its images in the planes of symmetry that it reaches.
template <int Dim, int Order>
Point middle_of(const SimplexMesh<Dim, Order>& mesh, const std::string& opening) {
  const auto& facets = *mesh.facets(opening);
  const auto planes = mirror_planes(mesh);
  std::vector<const MirrorPlane*> reached;
  for (const MirrorPlane& plane : planes) {
    const auto is_in_it = [&](int node) { return plane.holds[node] != 0; };
    if (std::any_of(facets.begin(), facets.end(),
                    [&](const auto& facet) { return std::any_of(facet.begin(), facet.end(), is_in_it); }))
      reached.push_back(&plane);
  }
  return projected(centre_of(mesh.nodes, facets), reached);
}

/// Where the centre line of a scene runs: the axis of a tube; in plane scenes the straight line from the middle of the
/// first opening to that of the second.
template <class Element>
Axis axis_of(const Case& setup, const MeshOf<Element>& mesh, const std::vector<std::string>& openings) {
  Axis axis;
  if (setup.structure) axis = {setup.structure->axis_origin, setup.structure->axis_direction};
  if constexpr (Element::axisymmetric) axis = {};
  if constexpr (Element::dim == 2 && !Element::axisymmetric)
    if (!openings.empty()) {
      axis.origin = middle_of(mesh, openings[0]);
      axis.direction = middle_of(mesh, openings[1]) - axis.origin;
    }
  return axis;
}

NodalSample in_part(std::vector<int> nodes, std::vector<double> weights, const PartNodes& part) {
  nodes.resize(weights.size());  // scalars live on the first ones
  for (int& node : nodes) node = part.local_node[node];
  return {std::move(nodes), std::move(weights)};
}

/// The fluid's pressure along the axis between two openings. \returns whether the axis runs from one to the other
/// through the fluid
template <class Element>
bool add_centre_line(const MeshOf<Element>& mesh, const std::vector<std::string>& openings, const PartNodes& fluid,
                     ObservationPoints& points) {
  constexpr double along_axis = 0.9;  // of the way from one opening to the other
  const auto &inlet = *mesh.facets(openings[0]), &outlet = *mesh.facets(openings[1]);
  const auto z = evenly_spaced(axial_position(mesh.nodes, inlet, points.axis),
                               axial_position(mesh.nodes, outlet, points.axis), line_points);
  if (Element::dim == 3 && std::abs(z.back() - z.front()) <
                               along_axis * distance(centre_of(mesh.nodes, inlet), centre_of(mesh.nodes, outlet)))
    return false;
  std::vector<PointSample> found;
  try {
    found = sample_in_cells(mesh, mesh.region_index(group::fluid), points_on_axis(points.axis, z));
  } catch (const InputError&) {
    return false;
  }
  points.centre_z = z;
  for (auto& sample : found)
    points.centre_line.push_back(in_part(std::move(sample.nodes), std::move(sample.scalar_weights), fluid));
  return true;
}

/// The inner wall's displacement around and along the axis; nothing where the wall does not lie around it.
template <class Element>
void add_wall_line(const Case& setup, const MeshOf<Element>& mesh, const PartNodes& wall, const std::string& source,
                   ObservationPoints& points) {
  const int fluid_region = mesh.region_index(group::fluid);
  std::vector<int> wall_regions;
  for (const auto& [name, data] : setup.structure->layers) wall_regions.push_back(mesh.region_index(name));
  const auto surface =
      fluid_region >= 0 ? interface_facets(mesh, fluid_region, wall_regions) : group_facets(mesh, group::inner);
  if (surface.empty()) return;
  const AxisFrame frame(points.axis);
  double first = frame.axial(mesh.nodes[surface[0][0]]), last = first;
  for (const auto& facet : surface)
    for (int node : facet) {
      first = std::min(first, frame.axial(mesh.nodes[node]));
      last = std::max(last, frame.axial(mesh.nodes[node]));
    }
  const int angles = Element::axisymmetric ? 1 : 16;
  const auto z = evenly_spaced(first, last, line_points);
  std::vector<WallSample> found;
  try {
    found = wall_samples<Element::dim>(mesh.nodes, surface, points.axis, z, angles,
                                       {source, fluid_region >= 0 ? "interface" : group::inner});
  } catch (const InputError& missing) {
    points.notes.push_back(
        fmt::format("no wall_displacement.csv, since the inner wall does not lie around the axis of "
                    "[structure] everywhere ({})",
                    missing.what()));
    return;
  }
  points.angles = angles;
  points.wall_z = z;
  for (auto& sample : found)
    points.wall_line.push_back({in_part(std::move(sample.nodes), std::move(sample.weights), wall), sample.direction});
}

/// The openings of the case that the mesh has.
template <class Element>
std::vector<std::string> openings_in(const Case& setup, const MeshOf<Element>& mesh) {
  std::vector<std::string> names;
  for (const auto& opening : openings_of(setup))
    if (const auto* facets = mesh.facets(opening.surface); facets && !facets->empty()) names.push_back(opening.surface);
  return names;
}

}  // namespace

template <class Element>
std::vector<std::string> tube_openings(const Case& setup, const MeshOf<Element>& mesh) {
  auto names = openings_in<Element>(setup, mesh);
  // A rigid wall under the name of an outlet ends a tube as well.
  if (names.size() == 1 && names[0] == group::inlet && mesh.facets(group::outlet)) names.push_back(group::outlet);
  if (names.size() != 2) return {};
  if (names[0] == group::outlet || names[1] == group::inlet) std::swap(names[0], names[1]);
  for (const std::string& name : names)
    if (pieces_of(*mesh.facets(name)) != 1) return {};
  return names;
}

template <class Element>
ObservationPoints observation_points(const Case& setup, const MeshOf<Element>& mesh, const VesselParts<Element>& parts,
                                     const std::string& source) {
  const auto openings = tube_openings<Element>(setup, mesh);
  ObservationPoints points;
  points.axis = axis_of<Element>(setup, mesh, openings);
  bool straight = openings.empty() && !parts.fluid;
  if (parts.fluid && !openings.empty() && norm(points.axis.direction) > 0)
    straight = add_centre_line<Element>(mesh, openings, *parts.fluid, points);
  constexpr bool tube = Element::dim == 3 || Element::axisymmetric;
  // A closed end has no second opening, but may have a wall around the axis.
  const bool may_be_straight = straight || Element::dim == 2 || openings_in<Element>(setup, mesh).size() < 2;
  if (parts.wall && tube && may_be_straight) add_wall_line<Element>(setup, mesh, *parts.wall, source, points);
  if (parts.wall && tube && !may_be_straight)
    points.notes.push_back("no wall_displacement.csv, since the vessel is no tube along the axis of [structure]");
  return points;
}

#define FSI_INSTANTIATE(Element)                                                                                  \
  template std::vector<std::string> tube_openings<Element>(const Case&, const MeshOf<Element>&);                  \
  template ObservationPoints observation_points(const Case&, const MeshOf<Element>&, const VesselParts<Element>&, \
                                                const std::string&);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
