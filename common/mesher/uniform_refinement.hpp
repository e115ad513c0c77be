#pragma once

#include <string>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Cuts each triangle into four and each tetrahedron into eight, `times` over, by the middles of the edges (red
/// refinement). Regions and groups stay; those of a facet hold its two or four parts. Nodes keep their numbers, new
/// ones follow.
///
/// A straight cell has straight children. A quadratic one is cut in its own coordinates: new nodes are
/// x(lambda) = sum N_i(lambda) x_i of the cell, so that children have the shape of the cell, curved faces and edges
/// stay where they were, and det J of a child is that of the cell, divided by 2^Dim.
///
/// Children of a triangle are similar to it. Of a tetrahedron four are; the octahedron between them is cut in four
/// along the shortest of its diagonals, and their children in the order of [Bey1995], by which not more than two shapes
/// other than the tetrahedron's come up, however often it is cut. So with straight edges no mean ratio falls below
/// `least_child_ratio` of that of the tetrahedron which it is a part of:
///   With S = sum of the squared edges, a tetrahedron's three segments between the middles of opposite edges have a sum
///   of squares S/4, so that the shortest, the diagonal, has at most S/12. The other five edges of the cells around it
///   are half as long as five of the tetrahedron's, their sum of squares is below S/4. With an eighth of the volume
///   eta = 12 (3 V)^(2/3) / sum of squares is more than (1/4) / (1/12 + 1/4) = 3/4 of the tetrahedron's.
///
/// \param file  for messages: where the mesh was read
/// \throws InputError for a child whose straight cell between its vertices is inverted or flat, which only strongly
///         curved edges bring about, and for more nodes or cells than there are numbers
/// \throws OutOfMemory for a mesh that will not fit
template <int Dim, int Order>
SimplexMesh<Dim, Order> refine_uniformly(const SimplexMesh<Dim, Order>& mesh, int times, const std::string& file);

inline constexpr double least_child_ratio = 0.75;  ///< of mean ratios, see refine_uniformly()

/// Numbers of what uniform refinement makes, without making it.
struct RefinedCounts {
  double nodes, cells;
};

/// By the counts of vertices, edges, faces and cells, each of which is cut in a known number of parts.
template <int Dim, int Order>
RefinedCounts refined_counts(const SimplexMesh<Dim, Order>& mesh, int times);

}  // namespace fsi
