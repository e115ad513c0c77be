#pragma once

#include <array>
#include <vector>

#include "mesh/simplex_mesh.hpp"
#include "mesh/surface_distance.hpp"

namespace fsi {

/// Where points lie in a wall that is to have a given thickness. Their reach is the distance from the surface that it
/// grows on over the thickness asked for at the nearest point there: 1 where the wall ends.
class OffsetDistance {
 public:
  /// \param thickness  mm, per node, above 0; between nodes it is linear
  OffsetDistance(const std::vector<Point>& nodes, const std::vector<std::array<int, 3>>& facets,
                 std::vector<double> thickness);

  struct Place {
    double distance = 0, asked = 1;  ///< mm
    Point away{};                    ///< unit vector from the nearest point
    Point nearest{};                 ///< mm
    int facet = -1;
    double reach() const { return distance / asked; }
  };
  /// \param guess  as of SurfaceDistance::nearest()
  Place at(const Point& x, int guess = -1) const;

  /// The first point of a ray of this reach, by steps that are never longer than what is missing [Hart1996]; where the
  /// ray comes closer to another part of the surface before, the point there.
  /// \param from  on the surface \param way  unit vector, away from it \param asked  mm, at `from`
  Point along(const Point& from, const Point& way, double asked, double reach) const;

  /// A point near x of this reach, mm: the nearest one that is that far from the tangent planes of all nearest points
  /// seen on the way. No step is longer than the distance from the surface, so that none leads through it.
  /// \param planes  unit normals, perpendicular to each other, of planes that the way lies in
  Point onto(Point x, double reach, const std::vector<Point>& planes, int guess = -1) const;

 private:
  SurfaceDistance surface_;
  std::vector<double> thickness_;
};

}  // namespace fsi
