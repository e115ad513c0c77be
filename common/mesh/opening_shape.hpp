#pragma once

#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// The shape of an opening of a lumen. Quadratic facets count as the flat triangles between their vertices.
struct OpeningShape {
  std::size_t triangles = 0;
  double area = 0;          ///< mm^2
  Point centre{0, 0, 0};    ///< of gravity, mm
  Point normal{0, 0, 0};    ///< unit, the mean one
  double off_plane = 0;     ///< largest distance of a vertex from the plane through the centre, mm
  int rims = 0;             ///< closed lines around it: one around a disk, two around an annulus
  double nearest_rim = 0;   ///< of the middles of the rims' edges from the centre, mm
  double farthest_rim = 0;  ///< of their vertices, mm
  double radius() const;    ///< of the disk of this area, mm

  bool flat() const;   ///< its vertices are within 5 % of the radius of one plane
  bool round() const;  ///< one rim, equally far from the centre within a quarter: so is a pentagon, not a square
};

/// \tparam Nodes  of a facet, 3 or 6
template <std::size_t Nodes>
OpeningShape shape_of_opening(const std::vector<Point>& nodes, const std::vector<std::array<int, Nodes>>& surface);

/// "12.6 mm^2, radius 2 mm, at (0, 0, 0) mm, flat, round": what it is, as a part of a sentence.
std::string to_text(const OpeningShape& shape);

/// How it differs from a disk cut across a vessel: "is one triangle", "is bent, ...", "has 2 rims, ..."; empty: not at
/// all. That it is not round does not count.
std::string said_of(const OpeningShape& shape);

}  // namespace fsi
