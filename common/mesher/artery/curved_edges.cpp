#include "mesher/artery/curved_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/error.hpp"
#include "mesh/curved_cells.hpp"
#include "mesh/mid_edge_nodes.hpp"

namespace fsi {

namespace {

Point curved_middle(const Point& a, const Point& b, double inner_radius) {
  Point middle{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
  const double ra = std::hypot(a[0], a[1]), rb = std::hypot(b[0], b[1]);
  if (ra == 0 || rb == 0) return middle;
  const double radius = 0.5 * (ra + rb);
  const double x = a[0] / ra + b[0] / rb, y = a[1] / ra + b[1] / rb;  // bisects the angle between the two
  const double curved = radius / std::hypot(x, y);
  const double inside = radius / inner_radius;
  // Rounding of a radius must not make an edge on the inner wall a little straight.
  const double share = inside > 1 - 1e-9 ? 1 : inside * inside;
  middle[0] += share * (curved * x - middle[0]);
  middle[1] += share * (curved * y - middle[1]);
  return middle;
}

/// Thin cells may lie between rings of few nodes, whose quadratic arcs meet.
void refuse_folded(const SimplexMesh<3, 2>& mesh) {
  for (const auto& cell : mesh.cells) {
    std::array<Point, 10> x;
    for (std::size_t a = 0; a < x.size(); ++a) x[a] = mesh.nodes[cell[a]];
    const auto jacobian = cell_jacobian<3>(x);
    if (!jacobian.positive)
      throw InputError("fsi-mesh", "--order", "a tetrahedron is " + bad_curved_cell(jacobian),
                       "choose more cells around, or grade them less");
  }
}

}  // namespace

SimplexMesh<3, 2> with_curved_edges(const TetrahedralMesh& tube, double inner_radius) {
  auto mesh = with_mid_edge_nodes(tube);
  const auto& edges = SimplexEdges<3>::vertices;
  for (const auto& cell : mesh.cells)
    for (std::size_t e = 0; e < edges.size(); ++e) {
      // By ascending number, so that every cell of an edge finds the same bits.
      const auto [a, b] = std::minmax(cell[edges[e][0]], cell[edges[e][1]]);
      mesh.nodes[cell[4 + e]] = curved_middle(mesh.nodes[a], mesh.nodes[b], inner_radius);
    }
  refuse_folded(mesh);
  return mesh;
}

}  // namespace fsi
