#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fluid/inflow_profile.hpp"

namespace fsi {

/// What an opening looks like.
struct OpeningShape {
  enum class Kind {
    circle,   ///< or a sector of one, or one about the axis: the profile depends on the distance from `centre`
    segment,  ///< straight, of a plane body: the profile depends on the distance from `centre`
    other
  };
  Kind kind = Kind::other;
  Point centre{};      ///< of the circle; of the segment its middle, or its end on a plane of symmetry, mm
  double radius = 0;   ///< of the circle; half the segment's width, or all of it with an end on a plane of symmetry, mm
  Point inward{};      ///< mean normal into the fluid, of unit length
  bool walled = true;  ///< whether the fluid sticks anywhere

  /// Part of the radius (of a segment its length, of a rectangle its area) by which an opening may miss the shape.
  static constexpr double tolerance = 0.01;
  static constexpr double largest_step = 61 * 3.14159265358979323846 / 180;  ///< between points of the rim, radians
};

/// A circle is flat, and the fluid sticks on its rim alone. Points of the rim are vertices and the mid-edge nodes of
/// curved edges: those at which the fluid sticks lie on the circle, no two neighbours more than 61 degrees apart, so
/// that a regular polygon counts from six corners on. The rest of the rim, on planes of symmetry, points at the centre.
/// A segment is straight, and the fluid sticks at one or both of its ends alone. Of a body of revolution one that runs
/// from the axis, at right angles to it, is a circle.
/// \throws InputError when the fluid sticks at every node of the opening, or its mean normal is zero
template <class Element>
OpeningShape shape_of(const InflowOpening<Element>& opening);

/// A flat rectangle of three dimensions, its sides walls or planes of symmetry.
struct OpeningRectangle {
  struct Side {
    Point along{};                                 ///< unit vector
    double from = 0, to = 0;                       ///< of the places x . along, mm
    bool first_walled = true, last_walled = true;  ///< whether the fluid sticks at the ends of these places
    /// 1 - (s/h)^2 from the middle between walls, or from the plane of symmetry beside one; 1 between such planes.
    double parabola(const Point& x) const;
  };
  std::array<Side, 2> sides;
  double parabolas(const Point& x) const { return sides[0].parabola(x) * sides[1].parabola(x); }
};

/// Empty where the opening is no rectangle, or the fluid sticks elsewhere than along whole sides, or there are two
/// dimensions. \param inward  OpeningShape::inward
template <class Element>
std::optional<OpeningRectangle> rectangle_of(const InflowOpening<Element>& opening, const Point& inward);

}  // namespace fsi
