#pragma once

#include <string>
#include <vector>

#include "mesher/surface/triangle_surface.hpp"

namespace fsi {

/// A repaired surface, and what was done to it.
struct SoundSurface {
  TriangleSurface surface;
  std::vector<std::string> done;  ///< sentences for the user
};

/// Checks a surface as a file holds it, open or closed, and turns its triangles so that all look outwards.
/// Repaired and reported: repeated triangles; triangles that look the other way than most around them, or all inwards.
/// With `largest` all shells but the one of the most triangles are left out.
/// \throws InputError saying of `file`, with the place: an edge at which more than two triangles meet; a node at which
///         parts of the surface touch; a surface of one side; more than one shell; triangles that cut each other
SoundSurface sound_surface(TriangleSurface surface, bool largest, const std::string& file);

}  // namespace fsi
