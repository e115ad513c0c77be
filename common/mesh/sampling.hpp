#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mesh/axis.hpp"
#include "mesh/simplex_mesh.hpp"
#include "mesh/submesh.hpp"

namespace fsi {

/// Where the points come from, for messages about one that is not there: a file, and a key or group in it.
struct SamplingPlace {
  std::string file, key;
};

/// Interpolation of nodal fields at one point: sums of weights times values at nodes, by the shape functions of the cell
/// that holds the point. Weights add up to 1.
struct PointSample {
  std::vector<int> nodes;              ///< of the cell, vertices first
  std::vector<double> weights;         ///< per node, of fields with the order of the mesh
  std::vector<double> scalar_weights;  ///< per vertex, of fields that are linear between the vertices
};

/// Finds for each point the cell of `region` (-1: of any) that holds it. Weights are exact for fields that are linear
/// (quadratic) in the cell's barycentric coordinates, which in curved cells are found by Newton's method. A point
/// outside by rounding or faceting gets the nearest cell, barycentric coordinates clamped to [0, 1].
/// Throws InputError for a point further away from all cells than half the longest edge of the nearest.
/// \param points  mm; in the plane of a triangle mesh
template <int Dim, int Order>
std::vector<PointSample> sample_in_cells(const SimplexMesh<Dim, Order>& mesh, int region,
                                         const std::vector<Point>& points, const SamplingPlace& from = {});

/// Finds for each point the cell of a part that holds it, numbers of nodes being the part's; empty for a point in none.
/// Weights as above. A point outside by less than a millionth of a cell counts as in it; one outside by more, be it only
/// because the cells' facets cut a curve short, does not. Among cells that share the point the one that holds it
/// deepest counts, then the first.
/// \param points  mm; of triangle parts those off their plane are in no cell
template <int Dim, int Order>
std::vector<std::optional<PointSample>> locate_in_cells(const Submesh<Dim, Order>& part,
                                                        const std::vector<Point>& points);

/// Interpolation at a point of the inner wall.
struct WallSample {
  Point direction;  ///< unit vector from the axis to the point
  std::vector<int> nodes;
  std::vector<double> weights;  ///< add up to 1
};

/// Points of a tube's inner wall at the given axial positions, `angles` for each, located on the facets in the unrolled
/// plane (angle, axial position) of the reference surface: exact at the nodes whatever the faceting. Sample k of
/// position i is entry i * angles + k. The mean over k of u . direction is the radial displacement there.
///
/// A whole tube is sampled at equally spaced angles, the first 0. If the surface covers a sector only, between planes
/// of symmetry, the same angles are mirrored into it when the sector is a whole part of the circle (so its mean is that
/// of the whole tube), else they lie in the middles of `angles` equal parts of it. Surfaces of axisymmetric meshes
/// (Dim = 2, edges in the (r, z) plane, the axis being z) have one sample for each position, in the direction of r.
/// Throws InputError for a position further off the surface than half the longest edge of the nearest facet.
/// \tparam Dim  of the mesh; the length of the facets does not tell it
template <int Dim = 3, std::size_t Nodes>
std::vector<WallSample> wall_samples(const std::vector<Point>& nodes,
                                     const std::vector<std::array<int, Nodes>>& surface, const Axis& axis,
                                     const std::vector<double>& positions, int angles = 16,
                                     const SamplingPlace& from = {});

/// Mean axial position of the nodes of a surface, mm from the axis' origin.
template <std::size_t Nodes>
double axial_position(const std::vector<Point>& nodes, const std::vector<std::array<int, Nodes>>& surface,
                      const Axis& axis);

/// `count` equally spaced numbers, first and last included exactly.
std::vector<double> evenly_spaced(double first, double last, int count);

/// Points on the axis at the given axial positions.
std::vector<Point> points_on_axis(const Axis& axis, const std::vector<double>& positions);

}  // namespace fsi
