#include "mesh/boundary.hpp"

#include <algorithm>
#include <cassert>
#include <tuple>
#include <utility>

#include "mesh/facets.hpp"

namespace fsi {

namespace {

std::vector<char> region_flags(const TetrahedralMesh& mesh, const std::vector<int>& regions) {
  assert(mesh.cell_region.size() == mesh.cells.size());
  std::vector<char> flags(mesh.regions.size(), regions.empty() ? 1 : 0);
  for (const int region : regions) {
    assert(region >= 0 && static_cast<std::size_t>(region) < flags.size());
    flags[region] = 1;
  }
  return flags;
}

void sort_unique(std::vector<int>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

std::vector<BoundaryFacet> boundary_facets(const TetrahedralMesh& mesh, const std::vector<int>& regions) {
  const auto in_set = region_flags(mesh, regions);
  const auto uses = sorted_facet_uses(mesh);

  std::vector<std::pair<int, int>> found;  // cell, local facet
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    int users = 0;
    const FacetUse* user = nullptr;
    for (end = begin; end < uses.size() && uses[end].key == uses[begin].key; ++end) {
      if (!in_set[mesh.cell_region[uses[end].cell]]) continue;
      ++users;
      user = &uses[end];
    }
    if (users == 1) found.emplace_back(user->cell, user->local);
  }
  std::sort(found.begin(), found.end());

  std::vector<BoundaryFacet> boundary;
  boundary.reserve(found.size());
  for (const auto& [cell, local] : found) boundary.push_back({outward_facets(mesh.cells[cell])[local], cell});
  return boundary;
}

std::vector<TetrahedralMesh::Facet> interface_facets(const TetrahedralMesh& mesh, int fluid_region,
                                                     const std::vector<int>& wall_regions) {
  if (fluid_region < 0 || wall_regions.empty()) return {};
  const auto wall = region_flags(mesh, wall_regions);
  const auto uses = sorted_facet_uses(mesh);

  std::vector<std::pair<int, int>> found;  // fluid cell, local facet
  for (std::size_t i = 0; i + 1 < uses.size(); ++i) {
    if (uses[i].key != uses[i + 1].key) continue;
    const int first = mesh.cell_region[uses[i].cell], second = mesh.cell_region[uses[i + 1].cell];
    if (first == fluid_region && wall[second]) found.emplace_back(uses[i].cell, uses[i].local);
    if (second == fluid_region && wall[first]) found.emplace_back(uses[i + 1].cell, uses[i + 1].local);
  }
  std::sort(found.begin(), found.end());

  std::vector<TetrahedralMesh::Facet> facets;
  facets.reserve(found.size());
  for (const auto& [cell, local] : found) facets.push_back(outward_facets(mesh.cells[cell])[local]);
  return facets;
}

std::vector<int> rim_nodes(const std::vector<TetrahedralMesh::Facet>& surface) {
  std::vector<std::pair<int, int>> edges;
  edges.reserve(3 * surface.size());
  for (const auto& f : surface)
    for (int i = 0; i < 3; ++i) edges.push_back(std::minmax({f[i], f[(i + 1) % 3]}));
  std::sort(edges.begin(), edges.end());

  std::vector<int> rim;
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    for (end = begin; end < edges.size() && edges[end] == edges[begin];) ++end;
    if (end - begin == 1) rim.insert(rim.end(), {edges[begin].first, edges[begin].second});
  }
  sort_unique(rim);
  return rim;
}

std::vector<int> facet_nodes(const std::vector<TetrahedralMesh::Facet>& surface) {
  std::vector<int> nodes;
  nodes.reserve(3 * surface.size());
  for (const auto& f : surface) nodes.insert(nodes.end(), f.begin(), f.end());
  sort_unique(nodes);
  return nodes;
}

}  // namespace fsi
