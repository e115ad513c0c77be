#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "mesh/group_names.hpp"
#include "mesh/simplex_mesh.hpp"
#include "mesher/artery/cross_section.hpp"

namespace fsi {

/// Extrudes a cross-section along the axis into `slabs` layers of prisms, each cut into three tetrahedra: volumes
/// `fluid`, `media`, `adventitia`, surfaces `inlet`, `outlet`, `wall_ends` and the section's sides. Nodes are numbered
/// station by station.
/// \param two_layers    whether there is an adventitia
/// \param place         (station, node of the section) -> Point, mm
/// \param starts_below  (a, b, slab) -> whether the diagonal of the face over the section's edge ab starts from a below
///     (and ends at b above). Adjacent prisms agree, as it depends on the edge only; within a triangle it must be an
///     order, so that the three diagonals of a prism never chase each other and three tetrahedra fill it
///     [Dompierre1999].
template <class Place, class StartsBelow>
TetrahedralMesh extrude(const CrossSection& section, bool two_layers, int slabs, const Place& place,
                        const StartsBelow& starts_below) {
  const int per_station = static_cast<int>(section.nodes.size());
  TetrahedralMesh mesh;
  mesh.regions = {group::fluid, "media"};
  if (two_layers) mesh.regions.emplace_back("adventitia");
  mesh.nodes.reserve(static_cast<std::size_t>(per_station) * (slabs + 1));
  for (int station = 0; station <= slabs; ++station)
    for (int i = 0; i < per_station; ++i) mesh.nodes.push_back(place(station, i));

  mesh.cells.reserve(3 * section.triangles.size() * slabs);
  for (int slab = 0; slab < slabs; ++slab)
    for (std::size_t t = 0; t < section.triangles.size(); ++t) {
      auto triangle = section.triangles[t];
      const auto first =
          std::min_element(triangle.begin(), triangle.end(), [&](int a, int b) { return starts_below(a, b, slab); });
      std::rotate(triangle.begin(), first, triangle.end());
      const int p = triangle[0] + slab * per_station, q = triangle[1] + slab * per_station,
                r = triangle[2] + slab * per_station;
      const int p1 = p + per_station, q1 = q + per_station, r1 = r + per_station;
      if (starts_below(triangle[1], triangle[2], slab))
        mesh.cells.insert(mesh.cells.end(), {{p, q, r, r1}, {p, q, r1, q1}, {p, q1, r1, p1}});
      else
        mesh.cells.insert(mesh.cells.end(), {{p, q, r, q1}, {p, r, r1, q1}, {p, q1, r1, p1}});
      mesh.cell_region.insert(mesh.cell_region.end(), 3, section.region[t]);
    }

  TetrahedralMesh::FacetGroup inlet{group::inlet, {}}, outlet{group::outlet, {}}, ends{group::wall_ends, {}};
  const int top = slabs * per_station;
  for (std::size_t t = 0; t < section.triangles.size(); ++t) {
    const auto& [a, b, c] = section.triangles[t];
    const bool fluid = section.region[t] == 0;
    (fluid ? inlet : ends).facets.push_back({a, c, b});
    (fluid ? outlet : ends).facets.push_back({a + top, b + top, c + top});
  }
  mesh.facet_groups = {inlet, outlet, ends};
  for (const auto& side : section.sides) {
    mesh.facet_groups.push_back({side.name, {}});
    auto& facets = mesh.facet_groups.back().facets;
    for (int slab = 0; slab < slabs; ++slab)
      for (const auto& [i, j] : side.edges) {
        const int a = i + slab * per_station, b = j + slab * per_station, a1 = a + per_station, b1 = b + per_station;
        if (starts_below(i, j, slab))
          facets.insert(facets.end(), {{a, b, b1}, {a, b1, a1}});
        else
          facets.insert(facets.end(), {{a, b, a1}, {b, b1, a1}});
      }
  }
  return mesh;
}

}  // namespace fsi
