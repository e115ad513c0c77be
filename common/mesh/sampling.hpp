#pragma once

#include <array>
#include <vector>

#include "mesh/axis.hpp"
#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Linear interpolation of a nodal field at one point: sum of weights times values at the nodes. Weights add up to 1.
struct PointSample {
  std::array<int, 4> nodes;
  std::array<double, 4> weights;
};

/// Finds for each point the cell of `region` (-1: of any) that holds it; weights are barycentric coordinates, exact for
/// linear fields. A point outside by rounding or faceting gets the nearest cell, weights clamped to [0, 1].
/// Throws InputError for a point further away from all cells than half the longest edge of the nearest.
std::vector<PointSample> sample_in_cells(const TetrahedralMesh& mesh, int region, const std::vector<Point>& points);

/// Linear interpolation at a point of the inner wall.
struct WallSample {
  Point direction;  ///< unit vector from the axis to the point
  std::array<int, 3> nodes;
  std::array<double, 3> weights;  ///< add up to 1
};

/// Points of a tube's inner wall at the given axial positions and `angles` equally spaced angles, located on the facets
/// in the unrolled plane (angle, axial position) of the reference surface: exact at the nodes whatever the faceting.
/// Sample k of position i is entry i * angles + k. The mean over k of u . direction is the radial displacement there.
/// Throws InputError for a position further off the surface than half the longest edge of the nearest facet.
std::vector<WallSample> wall_samples(const std::vector<Point>& nodes,
                                     const std::vector<TetrahedralMesh::Facet>& surface, const Axis& axis,
                                     const std::vector<double>& positions, int angles = 16);

/// Mean axial position of the nodes of a surface, mm from the axis' origin.
double axial_position(const std::vector<Point>& nodes, const std::vector<TetrahedralMesh::Facet>& surface,
                      const Axis& axis);

/// `count` equally spaced numbers, first and last included exactly.
std::vector<double> evenly_spaced(double first, double last, int count);

/// Points on the axis at the given axial positions.
std::vector<Point> points_on_axis(const Axis& axis, const std::vector<double>& positions);

}  // namespace fsi
