#include "mesher/prism_columns.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "base/sort_unique.hpp"
#include "mesh/boundary.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

using Facet = TetrahedralMesh::Facet;

std::map<int, int> Levels::bottoms() const {
  std::map<int, int> bottom;
  for (const auto& level : nodes)
    for (const auto& [below, node] : level) bottom[node] = below;
  return bottom;
}

std::array<TetrahedralMesh::Cell, 3> prism_cells(std::array<int, 3> below, std::array<int, 3> above) {
  // Turned so that the least comes first; the orientation stays.
  const auto least = std::min_element(below.begin(), below.end()) - below.begin();
  std::rotate(below.begin(), below.begin() + least, below.end());
  std::rotate(above.begin(), above.begin() + least, above.end());
  const auto [a, b, c] = below;
  const auto [d, e, f] = above;
  if (b < c) return {{{a, b, c, f}, {a, b, f, e}, {a, e, f, d}}};
  return {{{a, b, c, e}, {a, e, c, f}, {a, e, f, d}}};
}

Levels raise_levels(const std::vector<NewLevel>& made, const std::map<int, Point>& ways, TetrahedralMesh& mesh) {
  std::map<int, std::vector<Point>> columns;
  std::vector<int> regions;
  for (const auto& level : made) {
    regions.push_back(level.region);
    for (const auto& [node, way] : ways) columns[node].push_back(mesh.nodes[node] + level.height * way);
  }
  return raise_levels(regions, columns, mesh);
}

Levels raise_levels(const std::vector<int>& regions, const std::map<int, std::vector<Point>>& columns,
                    TetrahedralMesh& mesh) {
  Levels levels;
  levels.region = regions;
  levels.nodes.resize(regions.size() + 1);
  for (const auto& [node, column] : columns) levels.nodes[0][node] = node;
  for (std::size_t level = 0; level < regions.size(); ++level)
    for (const auto& [node, column] : columns) {
      levels.nodes[level + 1][node] = static_cast<int>(mesh.nodes.size());
      mesh.nodes.push_back(column[level]);
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
      const auto cells = prism_cells(below, above);
      mesh.cells.insert(mesh.cells.end(), cells.begin(), cells.end());
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
  sort_unique(regions);
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
