#pragma once

#include <array>
#include <optional>
#include <vector>

#include "derived/recovery_patches.hpp"

namespace fsi {

/// The shape of a body's boundary at a node to second order: normal and principal curvatures.
struct SurfaceShape {
  Point normal{};                     ///< unit vector
  std::array<Point, 2> directions{};  ///< of the curvatures, unit vectors; in two dimensions there is one
  std::array<double, 2> curvatures{
      0, 0};  ///< 1/mm, the smaller amount first; positive: the centre lies against the normal

  /// Coordinates in which surfaces parallel to this one are flat: arc lengths along the directions, and the distance
  /// along the normal; as a vector of space. It equals y to first order; exact for spheres and cylinders.
  /// \param y  from the node, mm
  /// \returns nothing near centres of curvature, where there are no such coordinates
  std::optional<Point> straightened(const Point& y) const;
  /// The shape of the parallel surface through another place. \param y  from the node, mm
  /// \returns nothing near centres of curvature
  std::optional<SurfaceShape> moved(const Point& y) const;
};

/// The shapes of the curved boundaries of a body, at nodes on them and at their neighbours (docs/theory.md, section
/// 11a.1). Facets that meet at less than 53 degrees are one smooth surface. At a node its normal and curvatures are
/// fitted to the nodes of the facets around. A node inside has the mean of the shapes of its neighbours on the
/// boundary, each moved to it.
class SurfaceShapes {
 public:
  explicit SurfaceShapes(const RecoveryCells& cells);

  /// Null where the boundary has no curved surface, and far from any boundary.
  const SurfaceShape* at(int node) const;

 private:
  /// \param flat_normals  gets, per node, those of boundaries there that are not curved
  void fit_to_boundary(const RecoveryCells& cells, std::vector<std::vector<Point>>& flat_normals);
  void carry_inwards(const RecoveryCells& cells, const std::vector<std::vector<Point>>& flat_normals);

  std::vector<int> place_;  ///< per node, in shapes_; -1: none
  std::vector<SurfaceShape> shapes_;
};

}  // namespace fsi
