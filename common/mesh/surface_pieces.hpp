#pragma once

#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Connected facets of a surface.
struct SurfacePiece {
  std::vector<std::size_t> facets;  ///< their places in the surface, ascending
  Point centre{0, 0, 0};            ///< of gravity, mm
  double size = 0;                  ///< mm^2; of edges mm
};

/// The parts of a surface that should be one flat opening.
struct SurfacePieces {
  /// Connected by shared edges, in two dimensions by shared vertices; the largest first.
  std::vector<SurfacePiece> pieces;
  /// Facets whose normal is more than 60 degrees from the mean of their piece, in connected parts, the largest first. A
  /// facet of the side beside a disk is one; a curved opening has none, nor has a piece whose facets look all round.
  std::vector<SurfacePiece> leaning;

  bool whole() const { return pieces.size() < 2 && leaning.empty(); }
};

/// \tparam Dim  of the mesh whose facets these are
template <int Dim, std::size_t Nodes>
SurfacePieces pieces_of(const std::vector<Point>& nodes, const std::vector<std::array<int, Nodes>>& surface);

/// "12.6 mm^2 about (0, 0, 0) mm, 12.6 mm^2 about (8, 0, 8) mm"; four at most, and how many more.
template <int Dim>
std::string places_of(const std::vector<SurfacePiece>& pieces);

/// What is wrong with a surface as an opening, "is in 2 pieces: ..."; empty: nothing.
template <int Dim>
std::string said_of(const SurfacePieces& pieces);

}  // namespace fsi
