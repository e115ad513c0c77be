#pragma once

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// The axis of a tube.
struct Axis {
  Point origin{0, 0, 0};     ///< mm; axial positions count from here
  Point direction{0, 0, 1};  ///< need not be normalised
};

/// Right-handed orthonormal frame of an axis. Angles count from `first` towards `second`; for the z axis from x
/// towards y.
struct AxisFrame {
  Point origin, first, second, along;

  /// Throws InputError when the direction is zero or not finite.
  explicit AxisFrame(const Axis& axis);

  double axial(const Point& x) const;   ///< mm along the axis from its origin
  double angle(const Point& x) const;   ///< radians in (-pi, pi]
  double radius(const Point& x) const;  ///< mm from the axis
  Point radial(double angle) const;     ///< unit vector away from the axis
};

}  // namespace fsi
