#include "mesh/prism_columns.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "mesh/boundary.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

using Facet = TetrahedralMesh::Facet;

namespace {

/// Tetrahedra of a prism (a0, b0, c0) below (a1, b1, c1), cut along the diagonals from the nodes of least number of each
/// quadrilateral: by the order of the numbers at the bottom.
void add_prism(std::array<int, 3> below, std::array<int, 3> above, std::vector<TetrahedralMesh::Cell>& cells) {
  // Turned so that the least comes first; the orientation stays.
  const auto least = std::min_element(below.begin(), below.end()) - below.begin();
  std::rotate(below.begin(), below.begin() + least, below.end());
  std::rotate(above.begin(), above.begin() + least, above.end());
  const auto [a, b, c] = below;
  const auto [d, e, f] = above;
  if (b < c) {
    cells.push_back({a, b, c, f});
    cells.push_back({a, b, f, e});
  } else {
    cells.push_back({a, b, c, e});
    cells.push_back({a, e, c, f});
  }
  cells.push_back({a, e, f, d});
}

}  // namespace

Levels raise_levels(const std::vector<NewLevel>& made, const std::map<int, Point>& ways, TetrahedralMesh& mesh) {
  Levels levels;
  levels.nodes.emplace_back();
  for (const auto& [node, way] : ways) levels.nodes[0][node] = node;
  for (const auto& [height, region] : made) {
    levels.nodes.emplace_back();
    for (const auto& [node, way] : ways) {
      levels.nodes.back()[node] = static_cast<int>(mesh.nodes.size());
      mesh.nodes.push_back(mesh.nodes[node] + height * way);
    }
    levels.region.push_back(region);
  }
  return levels;
}

void fill_with_prisms(const std::vector<Facet>& facets, const Levels& levels, TetrahedralMesh& mesh) {
  for (std::size_t step = 0; step < levels.region.size(); ++step)
    for (const auto& facet : facets) {
      std::array<int, 3> below{}, above{};
      for (int k = 0; k < 3; ++k) {
        below[k] = levels.nodes[step].at(facet[k]);
        above[k] = levels.nodes[step + 1].at(facet[k]);
      }
      add_prism(below, above, mesh.cells);
      mesh.cell_region.insert(mesh.cell_region.end(), 3, levels.region[step]);
    }
}
std::vector<Facet> sides_of_columns(const TetrahedralMesh& mesh, const std::vector<RimEdge>& rim,
                                    const Levels& levels) {
  std::set<int> rim_columns;
  for (const auto& [a, b] : rim) rim_columns.insert({a, b});
  std::map<int, int> column;
  for (const auto& nodes : levels.nodes)
    for (const auto& [bottom, node] : nodes)
      if (rim_columns.count(bottom) > 0) column[node] = bottom;
  std::vector<int> regions = levels.region;
  std::sort(regions.begin(), regions.end());
  regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
  std::set<RimEdge> rim_edges;
  for (const auto& [a, b] : rim) rim_edges.insert(std::minmax(a, b));
  std::vector<Facet> ends;
  for (const auto& facet : boundary_facets(mesh, regions)) {
    std::set<int> bottoms;
    bool on_rim = true;
    for (const int node : facet.nodes) {
      const auto found = column.find(node);
      on_rim = on_rim && found != column.end();
      if (on_rim) bottoms.insert(found->second);
    }
    if (on_rim && bottoms.size() == 2 && rim_edges.count({*bottoms.begin(), *bottoms.rbegin()}) > 0)
      ends.push_back(facet.nodes);
  }
  return ends;
}
}  // namespace fsi
