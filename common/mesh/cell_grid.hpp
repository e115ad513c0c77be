#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "base/bucket_sort.hpp"
#include "mesh/cell_map.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

/// The map of a cell. \tparam Mesh  a mesh or a part of one
template <int Dim, int Order, template <int, int> class Mesh>
CellMap<Dim, Order> map_of(const Mesh<Dim, Order>& mesh, int cell) {
  CellMap<Dim, Order> map;
  for (std::size_t i = 0; i < map.x.size(); ++i) map.x[i] = mesh.nodes[mesh.cells[cell][i]];
  return map;
}

/// Points in whose convex hull a cell lies: its vertices and, for each curved edge, the middle control point of its
/// Bezier curve.
template <int Dim, int Order, template <int, int> class Mesh>
std::array<Point, nodes_of_simplex(Dim, Order)> control_points(const Mesh<Dim, Order>& mesh, int cell) {
  auto x = map_of(mesh, cell).x;
  if constexpr (Order == 2)
    for (std::size_t e = 0; e < SimplexEdges<Dim>::vertices.size(); ++e) {
      const auto& [a, b] = SimplexEdges<Dim>::vertices[e];
      x[Dim + 1 + e] = 2 * x[Dim + 1 + e] - 0.5 * (x[a] + x[b]);
    }
  return x;
}

/// Cells sorted into the boxes of a regular grid that their bounding boxes touch, to find those near a point.
class CellGrid {
 public:
  template <int Dim, int Order, template <int, int> class Mesh>
  CellGrid(const Mesh<Dim, Order>& mesh, const std::vector<int>& cells) {
    low_.fill(std::numeric_limits<double>::infinity());
    Point high;
    high.fill(-std::numeric_limits<double>::infinity());
    for (const int c : cells)
      for (const Point& x : control_points(mesh, c))
        for (int d = 0; d < 3; ++d) {
          low_[d] = std::min(low_[d], x[d]);
          high[d] = std::max(high[d], x[d]);
        }
    // About one box per cell, cubic ones, so that a long tube gets many along its axis.
    double volume = 1;
    for (int d = 0; d < 3; ++d)
      if (Dim == 3 || high[d] > low_[d]) volume *= std::max(high[d] - low_[d], 1e-300);
    const double each = volume / static_cast<double>(cells.size());
    step_ = Dim == 3 ? std::cbrt(each) : std::sqrt(each);
    if (!(step_ > 0)) step_ = 1;
    for (int d = 0; d < 3; ++d) boxes_[d] = static_cast<int>(std::clamp((high[d] - low_[d]) / step_, 0.0, 1000.0)) + 1;

    std::vector<std::array<int, 2>> entries;  // box, cell
    for (const int c : cells) {
      std::array<int, 3> from{boxes_}, to{0, 0, 0};
      for (const Point& x : control_points(mesh, c))
        for (int d = 0; d < 3; ++d) {
          const int box = box_along(d, x[d]);
          from[d] = std::min(from[d], box);
          to[d] = std::max(to[d], box);
        }
      for (int i = from[0]; i <= to[0]; ++i)
        for (int j = from[1]; j <= to[1]; ++j)
          for (int k = from[2]; k <= to[2]; ++k) entries.push_back({box_number(i, j, k), c});
    }
    const std::size_t boxes = static_cast<std::size_t>(boxes_[0]) * boxes_[1] * boxes_[2];
    bucket_sort(
        entries, boxes, [](const auto& entry) { return entry[0]; }, std::less<>());
    start_.assign(boxes + 1, 0);
    for (const auto& entry : entries) {
      ++start_[entry[0] + 1];
      cells_.push_back(entry[1]);
    }
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
  }

  /// Cells that may hold the point, ascending.
  std::pair<const int*, const int*> near(const Point& x) const {
    const int box = box_number(box_along(0, x[0]), box_along(1, x[1]), box_along(2, x[2]));
    assert(box >= 0 && static_cast<std::size_t>(box) + 1 < start_.size());
    return {cells_.data() + start_[box], cells_.data() + start_[box + 1]};
  }

 private:
  int box_along(int d, double value) const {
    return static_cast<int>(std::clamp((value - low_[d]) / step_, 0.0, static_cast<double>(boxes_[d] - 1)));
  }
  int box_number(int i, int j, int k) const { return (i * boxes_[1] + j) * boxes_[2] + k; }

  Point low_;
  double step_;
  std::array<int, 3> boxes_;
  std::vector<int> start_, cells_;
};

}  // namespace fsi
