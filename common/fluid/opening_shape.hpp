#pragma once

#include <vector>

#include "fluid/inflow_profile.hpp"

namespace fsi {

/// What an opening looks like.
struct OpeningShape {
  enum class Kind {
    circle,   ///< or a sector of one, or one about the axis: w depends on the distance from `centre`
    segment,  ///< straight, of a plane body: w depends on the distance from `centre`
    other
  };
  Kind kind = Kind::other;
  Point centre{};      ///< of the circle; of the segment its middle, or its end on a plane of symmetry, mm
  double radius = 0;   ///< of the circle; half the segment's width, or all of it with an end on a plane of symmetry, mm
  Point inward{};      ///< mean normal into the fluid, of unit length
  bool walled = true;  ///< whether the fluid sticks anywhere

  static constexpr double tolerance = 0.01;  ///< of the radius, by which a node may miss the plane or the circle
  static constexpr double largest_step = 61 * 3.14159265358979323846 / 180;  ///< between points of the rim, radians
};

/// Circle: flat, and the points of the rim at which the fluid sticks lie on one, no two neighbours more than 61
/// degrees apart; of the rim what is left, on planes of symmetry, points at the centre. Middles of straight edges are no points:
/// a polygon between points of a circle is one, from six corners on.
/// \throws InputError when the fluid sticks at every node of the opening, or its mean normal is zero
template <class Element>
OpeningShape shape_of(const InflowOpening<Element>& opening);

}  // namespace fsi
