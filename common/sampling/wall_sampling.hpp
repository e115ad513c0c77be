#pragma once

#include <vector>

#include "mesh/axis.hpp"
#include "sampling/point_sampling.hpp"

namespace fsi {

/// Interpolation of the wall's vectors at a point of the inner wall.
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
/// of symmetry, the same angles are mirrored into it when the circle is a multiple of the sector (so its mean is that
/// of the whole tube), else they lie in the middles of `angles` equal parts of it. Surfaces of axisymmetric meshes
/// (Dim = 2, edges in the (r, z) plane, the axis being z) have one sample for each position, in the direction of r.
/// \param positions  mm along the axis from its origin
/// \throws InputError for a position further off the surface than half the longest edge of the nearest facet
/// \tparam Dim  of the mesh, which the number of a facet's nodes does not tell
template <int Dim = 3, std::size_t Nodes>
std::vector<WallSample> wall_samples(const std::vector<Point>& nodes,
                                     const std::vector<std::array<int, Nodes>>& surface, const Axis& axis,
                                     const std::vector<double>& positions, int angles = 16,
                                     const SamplingPlace& from = {});

/// Mean axial position of the nodes of a surface, mm from the axis' origin; 0 if it has none.
template <std::size_t Nodes>
double axial_position(const std::vector<Point>& nodes, const std::vector<std::array<int, Nodes>>& surface,
                      const Axis& axis);

/// Points on the axis at the given axial positions, mm.
std::vector<Point> points_on_axis(const Axis& axis, const std::vector<double>& positions);

}  // namespace fsi
