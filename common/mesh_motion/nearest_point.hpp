#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "mesh/point_math.hpp"

namespace fsi {

/// Distances from a cloud of points, by a k-d tree [Bentley1975]: the middle point of each stretch of the array parts
/// it along one axis, the axes taking turns.
class NearestPoint {
 public:
  /// \param points  one at least, mm
  explicit NearestPoint(std::vector<Point> points) : points_(std::move(points)) { sort(0, points_.size(), 0); }

  /// Distance in mm of the nearest of the points.
  double distance(const Point& from) const {
    double nearest = std::numeric_limits<double>::infinity();
    search(0, points_.size(), 0, from, nearest);
    return std::sqrt(nearest);
  }

 private:
  void sort(std::size_t begin, std::size_t end, int axis) {
    if (end - begin < 2) return;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](const Point& a, const Point& b) { return a[axis] < b[axis]; });
    sort(begin, middle, (axis + 1) % 3);
    sort(middle + 1, end, (axis + 1) % 3);
  }
  /// \param nearest  squared distance of the nearest so far
  void search(std::size_t begin, std::size_t end, int axis, const Point& from, double& nearest) const {
    if (begin >= end) return;
    const std::size_t middle = begin + (end - begin) / 2;
    const Point apart = from - points_[middle];
    nearest = std::min(nearest, dot(apart, apart));
    const double beyond = apart[axis];
    const bool below = beyond < 0;
    const int next = (axis + 1) % 3;
    below ? search(begin, middle, next, from, nearest) : search(middle + 1, end, next, from, nearest);
    if (beyond * beyond < nearest)
      below ? search(middle + 1, end, next, from, nearest) : search(begin, middle, next, from, nearest);
  }

  std::vector<Point> points_;
};

}  // namespace fsi
