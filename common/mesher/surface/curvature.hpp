#pragma once

#include <vector>

#include "mesher/surface/triangle_surface.hpp"

namespace fsi {

/// The larger of the absolute principal curvatures at each node, 1/mm: the eigenvalues of the shape operator of the
/// paraboloid
///   z = d x + e y + a x^2 + b x y + c y^2
/// that fits the nodes within two edges best by least squares, x and y in the tangent plane, z along the mean normal.
/// \param passes  the field is averaged with its neighbours' so many times
std::vector<double> largest_curvature(const TriangleSurface& surface, int passes);

/// Shortens edges to 2 / (k per_curvature), so that `per_curvature` of them go along the diameter of the circle of
/// curvature, but not below `shortest`, mm. On a round tube that is the length by diameter.
/// \param edges  mm, per node
void shorten_by_curvature(const TriangleSurface& surface, double per_curvature, double shortest,
                          std::vector<double>& edges);

}  // namespace fsi
