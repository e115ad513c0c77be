#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"
#include "mesh/submesh.hpp"

namespace fsi {

/// Source of the points for error messages: a file, and a key or group in it.
struct SamplingPlace {
  std::string file, key;
};

/// Interpolation of nodal fields at one point: sums of weights times values at nodes, by the shape functions of the
/// cell that contains the point. Weights add up to 1.
struct PointSample {
  std::vector<int> nodes;              ///< of the cell, vertices first
  std::vector<double> weights;         ///< per node, of fields with the order of the mesh
  std::vector<double> scalar_weights;  ///< per vertex, of fields that are linear between the vertices
};

/// Finds for each point the cell of `region` (-1: of any) that contains it. Weights are exact for fields that are
/// linear (quadratic) in the cell's barycentric coordinates, which in curved cells are found by Newton's method. A
/// point outside by rounding or faceting gets the nearest cell, barycentric coordinates clamped to [0, 1].
/// \param points  mm; in the plane of a triangle mesh
/// \throws InputError for a point further away from all cells than half the longest edge of the nearest, and for points
/// in a region without cells
template <int Dim, int Order>
std::vector<PointSample> sample_in_cells(const SimplexMesh<Dim, Order>& mesh, int region,
                                         const std::vector<Point>& points, const SamplingPlace& from = {});

/// Finds for each point the cell of a part that contains it, with the part's node numbers; empty for a point in none.
/// Weights as above. A point outside by less than a millionth of a cell counts as in it; one outside by more, be it
/// only because the cells' facets cut a curve short, does not. Among cells that share the point the one that contains
/// it deepest counts, then the first.
/// \param points  mm; of triangle parts those off their plane are in no cell
template <int Dim, int Order>
std::vector<std::optional<PointSample>> locate_in_cells(const Submesh<Dim, Order>& part,
                                                        const std::vector<Point>& points);

/// `count` equally spaced numbers, first and last included exactly.
std::vector<double> evenly_spaced(double first, double last, int count);

}  // namespace fsi
