#pragma once

#include <string>
#include <vector>

#include "mesher/surface/triangle_surface.hpp"

namespace fsi {

/// An opening of a lumen: a hole in its surface, or a flat part that closes it.
struct LumenOpening {
  std::string name;         ///< empty until it is given one
  bool capped;              ///< a flat part; it was taken out of the surface
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

/// Takes the flat parts (mesh/flat_regions.hpp) and domed ends (mesher/surface/domed_ends.hpp) out of a surface. One of several openings whose area is below a thousandth of
/// the largest is a hole like the others: a user that names openings sees it.
/// \param surface  sound (mesher/surface/sound_surface.hpp)
OpenedLumen opened(const TriangleSurface& surface);

/// What tells that a surface bounds no lumen with openings: two of them around each other, or none. A part of a sentence; empty
/// where nothing does.
std::string not_a_lumen(const OpenedLumen& lumen);

/// A table of them for the console, numbered from 1.
std::string to_text(const std::vector<LumenOpening>& openings);

/// What an option says of one opening: NAME=NUMBER or NAME=X,Y,Z; of `--closed` the part behind the name alone.
struct OpeningChoice {
  std::string name;
  int number = 0;  ///< from 1; 0: the one nearest to `at`
  Point at{0, 0, 0};
};

/// Which opening is meant. \param option  for messages
/// \throws InputError for a number that none has, and a point that is farther from all than their diameters
std::size_t chosen(const std::vector<LumenOpening>& openings, const OpeningChoice& choice, const std::string& option);

/// Which rim of a surface is that opening's: the one around the nearest place. Sets its place, normal and area anew.
std::vector<int> rim_of(const TriangleSurface& surface, LumenOpening& opening);

}  // namespace fsi
