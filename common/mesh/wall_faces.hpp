#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"
#include "mesh/surface_distance.hpp"
#include "parallel/communicator.hpp"

namespace fsi {

/// A face of a wall: distances from it, and its nodes in the numbers of the mesh.
struct WallFace {
  SurfaceDistance surface;
  std::vector<int> nodes;  ///< ascending; those in the middles of edges, too
};

/// Both faces of a wall. The inner one is the interface with the fluid, without a fluid the surface `inner`; the outer
/// one is the surface `outer`, or without one the rest of the wall's boundary that is in no named surface.
struct WallFaces {
  WallFace inner, outer;
};

/// None where the mesh has no such faces: a wall without a hollow, a fluid alone. A quadratic triangle is taken as
/// sixteen flat ones, a quadratic edge as four.
template <int Dim, int Order>
std::optional<WallFaces> faces_of_wall(const SimplexMesh<Dim, Order>& mesh);

/// Thickness of a wall at each node of its cells, mm: the sum of the distances from its two faces; 0 at other nodes. On
/// a face it is the distance from the other one, along a straight line across the wall the same. Empty where the mesh
/// has no such faces.
template <int Dim, int Order>
std::vector<double> nodal_thickness(const SimplexMesh<Dim, Order>& mesh);

/// How thick a wall is.
struct ThicknessRange {
  std::string name;  ///< of the layer; `wall` for several together
  struct Extreme {
    double distance = 0;  ///< mm
    Point at{};           ///< mm
  };
  Extreme least, most;             ///< distances of the outer face's nodes from the inner one
  Extreme least_seen_from_inside;  ///< distance of an inner face's node from the outer one
};

/// The wall's thickness; where it has several layers that lie one around the other, theirs before it, from inside
/// outwards. Empty where the mesh has no such faces.
/// \param processes  that have the whole mesh and share the work: collective
template <int Dim, int Order>
std::vector<ThicknessRange> thickness_ranges(const SimplexMesh<Dim, Order>& mesh,
                                             const Communicator& processes = Communicator::alone());

/// A line for each, ended by a newline.
std::string to_text(const std::vector<ThicknessRange>& ranges);

}  // namespace fsi
