#include "mesh/cells_across.hpp"

#include <unordered_set>
#include <vector>

#include "mesh/boundary.hpp"
#include "mesh/facets.hpp"
#include "mesh/group_names.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

template <int Order>
std::optional<CellsAcross> cells_across(const SimplexMesh<3, Order>& mesh) {
  const int fluid = mesh.region_index(group::fluid);
  if (fluid < 0) return std::nullopt;
  double volume = 0, length = 0, edges = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    if (mesh.cell_region[c] != fluid) continue;
    const auto at = [&](int vertex) { return mesh.nodes[mesh.cells[c][vertex]]; };
    volume += tetrahedron_volume(at(0), at(1), at(2), at(3));
    for (const auto& [a, b] : SimplexEdges<3>::vertices) length += distance(at(a), at(b));
    edges += static_cast<double>(SimplexEdges<3>::vertices.size());
  }
  std::unordered_set<FacetKey<3>, FacetKeyHash> named;
  for (const auto& surface : mesh.facet_groups)
    if (!group::is_no_opening(surface.name))
      for (const auto& facet : surface.facets) named.insert(facet_key<3>(facet));
  std::vector<int> walls;
  for (int region = 0; region < static_cast<int>(mesh.regions.size()); ++region)
    if (region != fluid) walls.push_back(region);
  for (const auto& facet : interface_facets(mesh, fluid, walls)) named.erase(facet_key<3>(facet));
  double area = 0;
  for (const auto& facet : boundary_facets(mesh, {fluid}))
    if (named.count(facet_key<3>(facet.nodes)) == 0)
      area += norm(
          triangle_area_vector(mesh.nodes[facet.nodes[0]], mesh.nodes[facet.nodes[1]], mesh.nodes[facet.nodes[2]]));
  if (!(area > 0) || edges == 0) return std::nullopt;
  return CellsAcross{4 * volume / area, length / edges};
}

template std::optional<CellsAcross> cells_across(const SimplexMesh<3, 1>&);
template std::optional<CellsAcross> cells_across(const SimplexMesh<3, 2>&);

}  // namespace fsi
