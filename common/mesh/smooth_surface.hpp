#pragma once

namespace fsi {

/// Cosine of the largest angle, 53 degrees, between the normals of neighbouring facets of one smooth surface. Where
/// they differ by more the surface has a fold. Edges are curved within a smooth surface
/// (mesher/surface/smooth_edges.hpp), and stresses are recovered by its shape (derived/surface_shape.hpp).
constexpr double smooth_surface_cosine = 0.6;

}  // namespace fsi
