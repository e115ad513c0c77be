#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"
#include "mesher/edge_curves.hpp"
#include "mesher/offset_normals.hpp"

namespace fsi {

/// Edges of a surface of triangles, curved as the smooth surface through its nodes.
struct SmoothEdges {
  EdgeCurves curves;
  std::size_t edges = 0;          ///< of the surface
  std::size_t curved = 0;         ///< by more than a thousandth of their length
  std::size_t sharp = 0;          ///< straight, since facets meet there in a fold
  double farthest = 0;            ///< mm, of a curve's middle from the straight edge's
  Point farthest_at{};            ///< mm
  std::vector<Point> not_fitted;  ///< nodes with the mean normal of their facets, mm
};

/// Facets of one smooth surface (mesh/smooth_surface.hpp) have the normal n at a node: that of the surface
///   z = d x + e y + (a x^2 + 2 b x y + c y^2 + k z^2) / 2,
///   k = (k_1^3 + k_2^3) / (k_1^2 + k_2^2) of the curvatures in (a, b, c),
/// which fits the nodes within two edges best by least squares, near ones with larger weights, with d = e = 0. k is the
/// curvature of spheres and cylinders, on which n is exact, and continuous between them. Where no such surface is found
/// n is the mean of the facets' normals. With the edge e from one end to the other the middle is moved out of the
/// straight edge's along n_1 + n_2, by
///   e . (n_2 - n_1) / (2 (2 + |n_1 + n_2|)),
/// the sagitta of the circle that has these normals: exact on spheres and cylinders, of the fourth order in the edge's
/// length elsewhere, given the normals. Edges of rims stay in the plane there, by normals that are laid into it.
/// \param facets  seen from outside counter-clockwise
/// \param rims    of these facets, as offset_normals() finds them
SmoothEdges smooth_edges(const std::vector<Point>& nodes, const std::vector<TetrahedralMesh::Facet>& facets,
                         const OffsetNormals& rims);

/// A sentence for the user, ended by a newline.
std::string to_text(const SmoothEdges& smooth);

}  // namespace fsi
