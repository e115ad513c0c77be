#pragma once

#include <map>
#include <string>
#include <vector>

#include "mesher/surface/lumen_openings.hpp"
#include "mesher/surface/triangle_surface.hpp"

namespace fsi {

/// Units of length of a surface's file, in mm.
extern const std::map<std::string, double> surface_units;

/// A segmented surface in a file, and how it is to be read.
struct SurfaceInput {
  std::string file;            ///< .stl, .ply, .obj or .vtp
  std::string unit;            ///< mm unless given
  bool largest_shell = false;  ///< leave out all other ones
};

/// Its triangles, mm, as the file holds them. \throws InputError
TriangleSurface triangles_of_file(const SurfaceInput& input);

/// The repaired surface without its caps, and its openings. Warns of openings that no vessel has in the unit given.
/// \param done  set to sentences on what was repaired
/// \throws InputError for what sound_surface() refuses, and for openings no vessel has in mm where no unit is given
OpenedLumen read_lumen_surface(const SurfaceInput& input, std::vector<std::string>& done);

}  // namespace fsi
