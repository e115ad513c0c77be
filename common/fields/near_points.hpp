#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "mesh/point_math.hpp"

namespace fsi {

/// The nearest of many points, by a k-d tree [Bentley1975]: the middle of each stretch of the order parts it along one
/// axis, the axes taking turns.
class NearPoints {
 public:
  /// Squared distance in mm^2 and number of a point.
  using Near = std::pair<double, std::size_t>;

  explicit NearPoints(std::vector<Point> points) : points_(std::move(points)), order_(points_.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    sort(0, order_.size(), 0);
  }

  const std::vector<Point>& points() const { return points_; }
  /// The nearest `count` points, or all; nearest first, equally near ones by their numbers.
  std::vector<Near> nearest(const Point& from, std::size_t count) const {
    std::vector<Near> near;
    search(0, order_.size(), 0, from, count, near);
    return near;
  }

 private:
  void sort(std::size_t begin, std::size_t end, int axis) {
    if (end - begin < 2) return;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end),
                     [&](std::size_t a, std::size_t b) { return points_[a][axis] < points_[b][axis]; });
    sort(begin, middle, (axis + 1) % 3);
    sort(middle + 1, end, (axis + 1) % 3);
  }
  void search(std::size_t begin, std::size_t end, int axis, const Point& from, std::size_t count,
              std::vector<Near>& near) const {
    if (begin >= end) return;
    const std::size_t middle = begin + (end - begin) / 2, number = order_[middle];
    const Point apart = from - points_[number];
    const Near found{dot(apart, apart), number};
    if (near.size() < count || found < near.back()) {
      near.insert(std::upper_bound(near.begin(), near.end(), found), found);
      if (near.size() > count) near.pop_back();
    }
    const double beyond = apart[axis];
    const int next = (axis + 1) % 3;
    beyond < 0 ? search(begin, middle, next, from, count, near) : search(middle + 1, end, next, from, count, near);
    if (near.size() < count || beyond * beyond <= near.back().first)
      beyond < 0 ? search(middle + 1, end, next, from, count, near) : search(begin, middle, next, from, count, near);
  }

  std::vector<Point> points_;
  std::vector<std::size_t> order_;
};

}  // namespace fsi
