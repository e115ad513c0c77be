#pragma once

#include <string>
#include <vector>

#include "mesher/surface/triangle_surface.hpp"

namespace fsi {

/// An opening of a lumen: a hole in its surface, or a flat or domed end that closed it.
struct LumenOpening {
  std::string name;         ///< empty until it is given one
  bool capped;              ///< a flat or domed end, which was taken out of the surface
  Point centre;             ///< mm
  Point normal;             ///< unit, out of the lumen
  double area;              ///< mm^2
  double diameter() const;  ///< mm, of the disk of this area
};

/// An open surface, and its openings: one for each rim, largest first.
struct OpenedLumen {
  TriangleSurface surface;
  std::vector<LumenOpening> openings;
};

/// Takes the flat parts (mesh/flat_regions.hpp) and domed ends (mesher/surface/domed_ends.hpp) out of a surface.
/// However small, each hole is an opening.
/// \param surface  sound (mesher/surface/sound_surface.hpp)
OpenedLumen opened(const TriangleSurface& surface);

/// Why a surface bounds no lumen with openings, in words.
struct LumenFault {
  std::string problem{}, remedy{};
  explicit operator bool() const { return !problem.empty(); }
};
/// A slit, two openings around each other, or none; empty where there is no reason.
LumenFault not_a_lumen(const OpenedLumen& lumen);

/// A table of them for the console, numbered from 1.
std::string to_text(const std::vector<LumenOpening>& openings);

/// An opening in an option: NAME=NUMBER or NAME=X,Y,Z; in `--closed` without the name.
struct OpeningChoice {
  std::string name;
  int number = 0;  ///< from 1; 0: the one nearest to `at`
  Point at{0, 0, 0};
};

/// Which opening is meant. \param option  for messages
/// \throws InputError for a number that none has, and a point farther from the nearest centre than that diameter
std::size_t chosen(const std::vector<LumenOpening>& openings, const OpeningChoice& choice, const std::string& option);

/// The rim of an opening: that with the nearest centre; empty where there is none. Updates its centre, normal and area.
std::vector<int> rim_of(const TriangleSurface& surface, LumenOpening& opening);

}  // namespace fsi
