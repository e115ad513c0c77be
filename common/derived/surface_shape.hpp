#pragma once

#include <array>
#include <optional>
#include <vector>

#include "derived/recovery_patches.hpp"

namespace fsi {

/// How the boundary of a body bends at a node: its normal and its principal curvatures, to second order.
struct SurfaceShape {
  Point normal{};                     ///< unit vector
  std::array<Point, 2> directions{};  ///< of the curvatures, unit vectors; in two dimensions there is one
  std::array<double, 2> curvatures{
      0, 0};  ///< 1/mm, the smaller amount first; positive: the centre lies against the normal

  /// Coordinates in which surfaces parallel to this one are flat: lengths of arcs along the directions, and the distance
  /// along the normal; as a vector of space. It is y itself to first order, and exact for spheres and cylinders.
  /// \param y  from the node, mm
  /// \returns nothing near centres of curvature, where there are no such coordinates
  std::optional<Point> straightened(const Point& y) const;
  /// The same parallel surface at another place. \param y  from the node, mm
  std::optional<SurfaceShape> moved(const Point& y) const;
};

/// The shapes of the curved boundaries of a body, at nodes on them and at those beside (docs/theory.md, section 11a.1).
/// Facets that meet at less than 53 degrees are one smooth surface. At a node its normal and curvatures are fitted to the
/// nodes of the facets around. A node inside has the mean of what its neighbours on the boundary have, each carried there.
class SurfaceShapes {
 public:
  explicit SurfaceShapes(const RecoveryCells& cells);

  /// Null: flat, at an edge only, or far from any boundary.
  const SurfaceShape* at(int node) const;

 private:
  /// \param flat_normals  gets, per node, those of boundaries there that are not curved
  void fit_to_boundary(const RecoveryCells& cells, std::vector<std::vector<Point>>& flat_normals);
  void carry_inwards(const RecoveryCells& cells, const std::vector<std::vector<Point>>& flat_normals);

  std::vector<int> place_;  ///< per node, in shapes_; -1: none
  std::vector<SurfaceShape> shapes_;
};

}  // namespace fsi
