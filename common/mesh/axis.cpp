#include "mesh/axis.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

AxisFrame::AxisFrame(const Axis& axis) : origin(axis.origin) {
  const double length = norm(axis.direction);
  if (!std::isfinite(length) || length == 0)
    throw InputError(
        "", "structure.axis_direction",
        fmt::format("({}, {}, {}) has no direction", axis.direction[0], axis.direction[1], axis.direction[2]),
        "give a vector along the tube, e.g. [0, 0, 1]");
  along = (1 / length) * axis.direction;
  const Point helper = std::abs(along[0]) < 0.9 ? Point{1, 0, 0} : Point{0, 1, 0};
  const Point projected = helper - dot(helper, along) * along;
  first = (1 / norm(projected)) * projected;
  second = cross(along, first);
}

double AxisFrame::axial(const Point& x) const {
  return dot(x - origin, along);
}

double AxisFrame::angle(const Point& x) const {
  return std::atan2(dot(x - origin, second), dot(x - origin, first));
}

double AxisFrame::radius(const Point& x) const {
  return std::hypot(dot(x - origin, first), dot(x - origin, second));
}

Point AxisFrame::radial(double angle) const {
  return std::cos(angle) * first + std::sin(angle) * second;
}

}  // namespace fsi
