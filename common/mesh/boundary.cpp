#include "mesh/boundary.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "base/sort_unique.hpp"
#include "mesh/facet_uses.hpp"
#include "mesh/facets.hpp"
#include "mesh/for_each_mesh.hpp"

namespace fsi {

namespace {

template <class Mesh>
std::vector<char> region_flags(const Mesh& mesh, const std::vector<int>& regions) {
  assert(mesh.cell_region.size() == mesh.cells.size());
  std::vector<char> flags(mesh.regions.size(), regions.empty() ? 1 : 0);
  for (const int region : regions) {
    assert(region >= 0 && static_cast<std::size_t>(region) < flags.size());
    flags[region] = 1;
  }
  return flags;
}

/// Flags of the nodes of cells in these regions.
template <class Mesh>
std::vector<char> nodes_of(const Mesh& mesh, const std::vector<char>& in_set) {
  std::vector<char> flags(mesh.nodes.size(), 0);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (in_set[mesh.cell_region[c]])
      for (const int node : mesh.cells[c]) flags[node] = 1;
  return flags;
}

}  // namespace

template <int Dim, int Order>
std::vector<BoundaryFacet<Dim, Order>> boundary_facets(const SimplexMesh<Dim, Order>& mesh,
                                                       const std::vector<int>& regions) {
  const auto in_set = region_flags(mesh, regions);
  const auto uses =
      sorted_facet_uses(mesh, [&](int cell, const FacetKey<Dim>&) { return in_set[mesh.cell_region[cell]] != 0; });

  std::vector<std::pair<int, int>> found;  // cell, local facet
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    for (end = begin; end < uses.size() && uses[end].key == uses[begin].key;) ++end;
    if (end - begin == 1) found.emplace_back(uses[begin].cell, uses[begin].local);
  }
  std::sort(found.begin(), found.end());

  std::vector<BoundaryFacet<Dim, Order>> boundary;
  boundary.reserve(found.size());
  for (const auto& [cell, local] : found)
    boundary.push_back({outward_facets<Dim, Order>(mesh.cells[cell])[local], cell});
  return boundary;
}

template <int Dim, int Order>
std::vector<typename SimplexMesh<Dim, Order>::Facet> interface_facets(const SimplexMesh<Dim, Order>& mesh,
                                                                      int fluid_region,
                                                                      const std::vector<int>& wall_regions) {
  if (fluid_region < 0 || wall_regions.empty()) return {};
  const auto wall = region_flags(mesh, wall_regions);
  const auto is_fluid = region_flags(mesh, {fluid_region});
  const auto in_fluid = nodes_of(mesh, is_fluid), in_wall = nodes_of(mesh, wall);
  const auto uses = sorted_facet_uses(mesh, [&](int, const FacetKey<Dim>& vertices) {  // few can be shared
    return std::all_of(vertices.begin(), vertices.end(), [&](int node) { return in_fluid[node] && in_wall[node]; });
  });

  std::vector<std::pair<int, int>> found;  // fluid cell, local facet
  for (std::size_t i = 0; i + 1 < uses.size(); ++i) {
    if (uses[i].key != uses[i + 1].key) continue;
    const int first = mesh.cell_region[uses[i].cell], second = mesh.cell_region[uses[i + 1].cell];
    if (first == fluid_region && wall[second]) found.emplace_back(uses[i].cell, uses[i].local);
    if (second == fluid_region && wall[first]) found.emplace_back(uses[i + 1].cell, uses[i + 1].local);
  }
  std::sort(found.begin(), found.end());

  std::vector<typename SimplexMesh<Dim, Order>::Facet> facets;
  facets.reserve(found.size());
  for (const auto& [cell, local] : found) facets.push_back(outward_facets<Dim, Order>(mesh.cells[cell])[local]);
  return facets;
}

template <int Dim, std::size_t Nodes>
std::vector<int> rim_nodes(const std::vector<std::array<int, Nodes>>& surface) {
  static_assert(Nodes == nodes_of_simplex(Dim - 1, 1) || Nodes == nodes_of_simplex(Dim - 1, 2));
  // Sides of the facets: two vertices of an edge, or one vertex twice; then the node in the middle, -1 for none.
  std::vector<std::array<int, 3>> sides;
  sides.reserve(Dim * surface.size());
  for (const auto& f : surface)
    for (int i = 0; i < Dim; ++i) {
      const auto [a, b] = Dim == 3 ? std::minmax({f[i], f[(i + 1) % 3]}) : std::make_pair(f[i], f[i]);
      sides.push_back({a, b, Dim == 3 && Nodes == 6 ? f[(3 + i) % Nodes] : -1});
    }
  std::sort(sides.begin(), sides.end());

  std::vector<int> rim;
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    for (end = begin; end < sides.size() && sides[end][0] == sides[begin][0] && sides[end][1] == sides[begin][1];)
      ++end;
    if (end - begin > 1) continue;
    for (const int node : sides[begin])
      if (node >= 0) rim.push_back(node);
  }
  sort_unique(rim);
  return rim;
}

template <std::size_t Nodes>
std::vector<int> facet_nodes(const std::vector<std::array<int, Nodes>>& surface) {
  std::vector<int> nodes;
  nodes.reserve(Nodes * surface.size());
  for (const auto& f : surface) nodes.insert(nodes.end(), f.begin(), f.end());
  sort_unique(nodes);
  return nodes;
}

// Numbers as template arguments: parentheses would only hide them.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define INSTANTIATE(Dim, Order)                                                                              \
  template std::vector<BoundaryFacet<Dim, Order>> boundary_facets(const SimplexMesh<Dim, Order>&,            \
                                                                  const std::vector<int>&);                  \
  template std::vector<SimplexMesh<Dim, Order>::Facet> interface_facets(const SimplexMesh<Dim, Order>&, int, \
                                                                        const std::vector<int>&);            \
  template std::vector<int> rim_nodes<Dim>(const std::vector<std::array<int, nodes_of_simplex(Dim - 1, Order)>>&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

template std::vector<int> facet_nodes(const std::vector<std::array<int, 2>>&);
template std::vector<int> facet_nodes(const std::vector<std::array<int, 3>>&);
template std::vector<int> facet_nodes(const std::vector<std::array<int, 6>>&);

}  // namespace fsi
