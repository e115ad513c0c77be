#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mesh/edge_curves.hpp"
#include "mesh/offset_normals.hpp"
#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Edges of a surface of triangles, bent as the surface is that its nodes show.
struct SmoothEdges {
  EdgeCurves curves;
  std::size_t edges = 0;   ///< of the surface
  std::size_t curved = 0;  ///< by more than a thousandth of their length
  std::size_t sharp = 0;   ///< straight, since facets meet there in a fold
  double farthest = 0;     ///< mm, of a curve's middle from the straight edge's
  Point farthest_at{};     ///< mm
};

/// Facets that meet at less than 53 degrees are one smooth surface. At a node n is its normal: that of the surface
///   z = d x + e y + (a x^2 + 2 b x y + c y^2 + k z^2) / 2,   k the larger amount of the curvatures in (a, b, c),
/// which fits the nodes within two edges best by least squares, the near ones above all, once d = e = 0. On spheres and cylinders
/// n is exact where the iteration converges; beside a fold, where a node sees one side alone, a hundred steps may end before,
/// and leave middles of edges 3e-5 of the radius off (measured on a half tube). With the edge e from one end to the other the middle is moved out of the straight edge's along n_1 + n_2, by
///   e . (n_2 - n_1) / (2 (2 + |n_1 + n_2|)),
/// the sagitta of the circle that has these normals: exact on spheres and cylinders, of the fourth order in the edge's length
/// elsewhere, given the normals. Edges of rims stay in the plane there, by normals that are laid into it.
/// \param facets  seen from outside counter-clockwise
/// \param rims    of these facets, as offset_normals() finds them
SmoothEdges smooth_edges(const std::vector<Point>& nodes, const std::vector<TetrahedralMesh::Facet>& facets,
                         const OffsetNormals& rims);

/// A sentence for the user, ended by a newline.
std::string to_text(const SmoothEdges& smooth);

}  // namespace fsi
