#pragma once

#include <filesystem>

#include "mesher/surface/triangle_surface.hpp"

namespace fsi {

/// The triangles of a file: STL (text or binary), PLY, OBJ, VTP. Polygons are cut into triangles; nodes at one place become
/// one. Nothing else is checked: mesher/surface/sound_surface.hpp does that.
/// \throws InputError for a file that is missing, of another kind or cut off, without triangles, or with numbers that
///         are not finite
TriangleSurface read_triangles(const std::filesystem::path& file);

}  // namespace fsi
