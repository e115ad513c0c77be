#pragma once

#include <cmath>

#include "mesh/group_names.hpp"
#include "mesh/submesh.hpp"
#include "mesher/artery/curved_edges.hpp"
#include "mesher/artery_generator.hpp"

namespace fsi::test {

/// The fluid of a vessel and its two openings, in the numbers of the part.
template <int Dim, int Order>
struct Vessel {
  Submesh<Dim, Order> part;
  std::vector<typename Submesh<Dim, Order>::Facet> inlet, outlet;
};

template <int Dim, int Order>
Vessel<Dim, Order> fluid_of(const SimplexMesh<Dim, Order>& mesh) {
  Vessel<Dim, Order> vessel;
  vessel.part = submesh(mesh, {mesh.region_index(group::fluid)});
  for (const auto& facet : *mesh.facets(group::inlet)) vessel.inlet.push_back(vessel.part.local(facet));
  for (const auto& facet : *mesh.facets(group::outlet)) vessel.outlet.push_back(vessel.part.local(facet));
  return vessel;
}

/// A tube of radius 1 along z from 0 to `length`, or a sector of it, in a wall of one layer.
inline TetrahedralMesh tube_mesh(double length, int across, int along, int degrees = 360) {
  ArteryShape shape;
  shape.inner_radius = 1;
  shape.media = 0.2;
  shape.adventitia = 0;
  shape.length = length;
  ArteryCells cells;
  cells.lumen = across;
  cells.media = 1;
  cells.around = 6 * across;
  cells.axial = along;
  return generate_artery(shape, cells, degrees);
}

/// The fluid of such a tube.
template <int Order>
Vessel<3, Order> straight_vessel(double length, int across, int along) {
  const auto tube = tube_mesh(length, across, along);
  if constexpr (Order == 1)
    return fluid_of(tube);
  else
    return fluid_of(with_curved_edges(tube, 1));
}

/// The tube bent about the y axis through (bend, 0, 0): its axis runs on a circle from (0, 0, 0) along z towards +x.
template <int Dim, int Order>
void bend_about(double bend, Submesh<Dim, Order>& part) {
  for (Point& x : part.nodes) {
    const double angle = x[2] / bend, radius = bend - x[0];
    x = {bend - radius * std::cos(angle), x[1], radius * std::sin(angle)};
  }
}

/// Where the bent axis is after an arc length s.
inline Point on_bend(double bend, double s) {
  return {bend * (1 - std::cos(s / bend)), 0, bend * std::sin(s / bend)};
}

}  // namespace fsi::test
