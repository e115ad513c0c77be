#include "mesher/curved_columns.hpp"

#include <algorithm>
#include <cstddef>
#include <map>

#include "mesh/point_math.hpp"

namespace fsi {

EdgeCurves with_columns(const TetrahedralMesh& mesh, const Levels& levels, const EdgeCurves& surface) {
  const auto bottom = levels.bottoms();
  const std::size_t top = levels.nodes.size() - 1;
  EdgeCurves curves = surface;
  for (const auto& [edge, middle] : surface) {
    const auto foot = bottom.find(edge.first), other_foot = bottom.find(edge.second);
    if (foot == bottom.end() || other_foot == bottom.end()) continue;
    const int a = foot->second, b = other_foot->second;
    const auto node = [&](std::size_t level, int of) { return levels.nodes[level].at(of); };
    Point above = middle;
    for (std::size_t level = top; level-- > 0;) {
      const Point one = mesh.nodes[node(level, a)] - mesh.nodes[edge.first],
                  other = mesh.nodes[node(level, b)] - mesh.nodes[edge.second], sum = one + other;
      const Point here = middle + (0.5 * (norm(one) + norm(other)) / norm(sum)) * sum;
      curves[std::minmax(node(level, a), node(level, b))] = here;
      // One of the two is an edge of the side that the columns on a and b have together.
      for (const auto& [low, high] : {std::pair(a, b), std::pair(b, a)})
        curves[std::minmax(node(level, low), node(level + 1, high))] = 0.5 * (here + above);
      above = here;
    }
  }
  return curves;
}

std::vector<Point> straighten_folded_columns(const TetrahedralMesh& mesh, const Levels& levels, EdgeCurves& surface) {
  const auto bottom = levels.bottoms();
  const auto& ends = levels.nodes.back();
  std::vector<Point> straightened;
  for (bool changed = true; changed;) {
    changed = false;
    for (const int cell : folded_cells(with_curves(mesh, with_columns(mesh, levels, surface))))
      for (const int one : mesh.cells[cell])
        for (const int other : mesh.cells[cell]) {
          const auto a = bottom.find(one), b = bottom.find(other);
          if (a == bottom.end() || b == bottom.end() || a->second == b->second) continue;
          const auto curve = surface.find(std::minmax(ends.at(a->second), ends.at(b->second)));
          if (curve == surface.end()) continue;
          straightened.push_back(curve->second);
          surface.erase(curve);
          changed = true;
        }
  }
  return straightened;
}

}  // namespace fsi
