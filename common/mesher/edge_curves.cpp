#include "mesher/edge_curves.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "mesh/curved_cells.hpp"
#include "mesh/mid_edge_nodes.hpp"

namespace fsi {

namespace {

constexpr auto edges = SimplexEdges<3>::vertices;

std::array<Point, 10> nodes_of(const SimplexMesh<3, 2>& mesh, std::size_t cell) {
  std::array<Point, 10> x;
  for (std::size_t a = 0; a < x.size(); ++a) x[a] = mesh.nodes[mesh.cells[cell][a]];
  return x;
}

}  // namespace

EdgeCurves curves_of(const SimplexMesh<3, 2>& mesh) {
  const auto vertices = without_mid_edge_nodes(mesh);
  EdgeCurves curves;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (std::size_t e = 0; e < edges.size(); ++e)
      curves.try_emplace(std::minmax(vertices.cells[c][edges[e][0]], vertices.cells[c][edges[e][1]]),
                         mesh.nodes[mesh.cells[c][4 + e]]);
  return curves;
}

SimplexMesh<3, 2> with_curves(const TetrahedralMesh& mesh, const EdgeCurves& curves) {
  auto quadratic = with_mid_edge_nodes(mesh);
  for (const auto& cell : quadratic.cells)
    for (std::size_t e = 0; e < edges.size(); ++e)
      if (const auto curve = curves.find(std::minmax(cell[edges[e][0]], cell[edges[e][1]])); curve != curves.end())
        quadratic.nodes[cell[4 + e]] = curve->second;
  return quadratic;
}

std::vector<int> folded_cells(const SimplexMesh<3, 2>& mesh) {
  std::vector<int> folded;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto x = nodes_of(mesh, c);
    if (!is_surely_positive<3>(x) && !cell_jacobian<3>(x).positive) folded.push_back(static_cast<int>(c));
  }
  return folded;
}

std::vector<Point> straighten_folded(const TetrahedralMesh& mesh, EdgeCurves& curves) {
  std::vector<Point> straightened;
  for (bool changed = true; changed;) {
    changed = false;
    for (const int cell : folded_cells(with_curves(mesh, curves)))
      for (const auto& [a, b] : edges)
        if (const auto curve = curves.find(std::minmax(mesh.cells[cell][a], mesh.cells[cell][b]));
            curve != curves.end()) {
          straightened.push_back(curve->second);
          curves.erase(curve);
          changed = true;
        }
  }
  return straightened;
}

double volume_of(const SimplexMesh<3, 2>& mesh, int region) {
  double volume = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (mesh.cell_region[c] == region) volume += cell_jacobian<3>(nodes_of(mesh, c)).mean / 6;
  return volume;
}

}  // namespace fsi
