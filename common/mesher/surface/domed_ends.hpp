#pragma once

#include <vector>

#include "mesher/surface/triangle_surface.hpp"

namespace fsi {

/// A part of a closed surface that bulges as the cap of a vessel may, and is set off by a crease.
struct DomedEnd {
  std::vector<int> triangles;  ///< ascending
  Point centre;                ///< of gravity, mm
};

/// Whole parts between creases of 30 degrees: each with one rim of five edges or more, with 4 pi area / length^2 of 0.4
/// or more, along which the surface turns inwards by 60 degrees on average. Its triangles look one way on the whole
/// (mean unit normal of length 0.9 or more), but not all of them within 2 degrees: flat parts are found by
/// mesh/flat_regions.hpp.
/// \param taken  per triangle: not 0 excludes the part that it is in
std::vector<DomedEnd> domed_ends(const TriangleSurface& surface, const std::vector<char>& taken);

}  // namespace fsi
